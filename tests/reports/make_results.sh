#!/usr/bin/env bash
# make_results.sh DIR ROWS [PER_GROUP]: a folder as a run leaves it, with ROWS cases in 20 methods and
# ten k, PER_GROUP of them (200) in one workload, and 63 samples a case (three launches of three
# frames, seven metrics). The numbers are invented and always the same.
set -euo pipefail
directory=$1 rows=$2 group=${3:-200}
mkdir -p "$directory"
awk 'BEGIN {
    printf "{\"schema\": 1, \"run_id\": \"0123456789abcdef\", \"figures\": [], \"methods\": {"
    for (i = 0; i < 20; i++)
        printf "%s\"m%d\": {\"title\": \"M%d\", \"version\": \"1\"}", i ? ", " : "", i, i
    print "}, \"devices\": [{\"selector\": \"vulkan\", \"name\": \"card\", \"is_software\": true}]}"
}' >"$directory/manifest.json"
awk -v rows="$rows" -v group="$group" 'BEGIN {
    printf "schema,case_id,status,message,method,method_version,device,device_name,feed,scene,"
    printf "width_px,height_px,n,k,r,pixel_density,fragment_probability,tessellation,order,seed,"
    printf "options,launches,samples,frame_ms,frame_ms_low,frame_ms_high,clear_ms,count_ms,"
    printf "reference_ms,store_ms,resolve_ms,times_floor,bytes_allocated,bytes_predicted,"
    printf "bytes_used,fragments_generated,fragments_stored,fragments_lost,missing,extra,"
    printf "misordered,depth_ulp_max,rmse,psnr_db,max_abs,ssim,flip,truncation_rmse,"
    print "distinct_images,frame_wall_ms,fragments_per_s"
    for (i = 0; i < rows; i++) {
        ms = 1 + i * 7919 % 10007 / 1000
        printf "1,%016x,ok,,m%d,1,vulkan,card,raster,layers,", i, i % 20
        printf "%d,480,%d,%d,,0.25,1,16,random,1,", 64 + int(i / group), 16, 2 + int(i / 20) % 10
        if (group > 200) # more than methods and k can tell apart
            printf "tile=%d", i % group / 200
        printf ",3,9,%g,%g,%g,0.1,,,%g,0.2,2,4096,4096,4096,", ms, ms * 0.95, ms * 1.05, ms - 0.3
        printf "1000,1000,0,0,0,0,0,%g,60,0.1,1,,%g,1,%g,1e6\n", i * 31 % 997 / 1e4, 0.01, ms + 1
    }
}' >"$directory/summary.csv"
awk -v rows="$rows" 'BEGIN {
    split("frame_ms clear_ms store_ms resolve_ms floor_store_ms floor_frame_ms canary_ns", name, " ")
    print "schema,run_id,case_id,launch,frame,metric,value,unit"
    for (launch = 0; launch < 3; launch++)
        for (i = 0; i < rows; i++)
            for (frame = 0; frame < 3; frame++)
                for (m = 1; m <= 7; m++)
                    printf "1,0123456789abcdef,%016x,%d,%d,%s,%g,%s\n", i, launch, frame, name[m],
                        1 + (i + frame) % 100 / 100, m == 7 ? "ns" : "ms"
}' >"$directory/samples.csv"

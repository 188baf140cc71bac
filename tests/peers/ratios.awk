# ratios.awk: of a run's summary.csv and samples.csv, a row for each pair of a method and its opponent:
#   scene, k, ours, peer, ratio (our frame over theirs), low, high, launches, status of ours, of theirs, and
#   whose row is noisy: ours, peer, both, or nobody's
# A launch counts as one number, the median of its frames at full clock, and its ratio is to the same launch of
# the other, which ran in the same round. The ratio is their median. Its interval is of order statistics that
# hold the median of all launches with 95 % at least; of 5 launches and fewer it is the whole range, which
# holds less (5: 93.75 %), and of one launch there is none.
function fields(line, cells,    count, i, c, is_quoted, cell) {
    count = 0
    cell = ""
    is_quoted = 0
    for (i = 1; i <= length(line); i++) {
        c = substr(line, i, 1)
        if (c == "\"")
            is_quoted = !is_quoted
        else if (c == "," && !is_quoted) {
            cells[++count] = cell
            cell = ""
        } else
            cell = cell c
    }
    cells[++count] = cell
    return count
}
function sort(x, n,    i, j, item) {
    for (i = 2; i <= n; i++) {
        item = x[i]
        for (j = i - 1; j >= 1 && x[j] > item; j--)
            x[j + 1] = x[j]
        x[j + 1] = item
    }
}
function median(x, n) {
    sort(x, n)
    return n % 2 ? x[(n + 1) / 2] : (x[n / 2] + x[n / 2 + 1]) / 2
}
# The rank of the lower end of n sorted numbers: as far in as 2.5 % of a fair coin's n throws allow.
function rank_low(n,    rank, chance, below) {
    chance = 0.5 ^ n
    below = chance
    for (rank = 1; below + chance * (n - rank + 1) / rank <= 0.025; rank++) {
        chance *= (n - rank + 1) / rank
        below += chance
    }
    return rank
}
# The launch's time; "": none.
function time_of(id, launch,    i, n, x) {
    n = 0
    for (i = 1; i <= frames[id, launch]; i++)
        if (!((id, launch, frame[id, launch, i]) in is_slow))
            x[++n] = time[id, launch, i]
    return n > 0 ? median(x, n) : ""
}
function compare(ours, peer, k,    a, b, i, n, x, x_a, x_b, low) {
    a = case_of[ours, k]
    b = case_of[peer, k]
    if (a == "" || b == "")
        return
    n = 0
    for (i = 0; i < launches; i++) {
        x_a = time_of(a, i)
        x_b = time_of(b, i)
        if (x_a != "" && x_b != "" && x_b > 0)
            x[++n] = x_a / x_b
    }
    printf "%s,%s,%s,%s,", run, k, ours, peer
    if (n == 0)
        printf ",,,"
    else if (n == 1)
        printf "%.4g,,,", x[1]
    else {
        low = rank_low(n)
        printf "%.4g,", median(x, n)
        printf "%.4g,%.4g,", x[low], x[n + 1 - low]
    }
    printf "%d,%s,%s,%s\n", n, status[a], status[b], noisy_of[noisy[a] != "", noisy[b] != ""]
}
FNR == 1 {
    count = fields($0, names)
    delete at
    for (i = 1; i <= count; i++)
        at[names[i]] = i
    file++
    next
}
file == 1 { # summary.csv
    fields($0, cell)
    id = cell[at["case_id"]]
    k = cell[at["k"]]
    case_of[cell[at["method"]], k] = id
    status[id] = cell[at["status"]]
    noisy[id] = cell[at["noisy"]]
    if (!(k in is_seen)) {
        is_seen[k] = 1
        k_of[++k_count] = k
    }
    next
}
{ # samples.csv: no texts but the last, so no quotes
    split($0, cell, ",")
    id = cell[at["case_id"]]
    launch = cell[at["launch"]]
    if (launch == "" || cell[at["frame"]] == "")
        next
    if (launch >= launches)
        launches = launch + 1
    if (cell[at["metric"]] == "frame_ms") {
        i = ++frames[id, launch]
        frame[id, launch, i] = cell[at["frame"]]
        time[id, launch, i] = cell[at["value"]] + 0
    } else if (cell[at["metric"]] == "off_clock")
        is_slow[id, launch, cell[at["frame"]]] = 1
}
END {
    pairs = split("kplus-array peer-array kplus-array peer-spinlock kplus-heap peer-heap kplus-heap peer-spinlock " \
        "kb-mdt32 loop32 kb-mdt64 loop64 kb-ab-ll peer-list s-buffer peer-s-buffer", pair, " ")
    noisy_of[1, 0] = "ours"
    noisy_of[0, 1] = "peer"
    noisy_of[1, 1] = "both"
    print "scene,k,ours,peer,ratio,low,high,launches,status,peer_status,noisy"
    for (j = 1; j <= k_count; j++)
        for (i = 1; i < pairs; i += 2)
            compare(pair[i], pair[i + 1], k_of[j])
}

/* How busy the host is, and how much of it this process gets: read before and after the timed
 * frames of a launch, never between them. */
#ifndef FM_HOST_LOAD_H
#define FM_HOST_LOAD_H

/* Running totals, but for the last two. NAN: this system does not tell. */
typedef struct fm_host_load {
    double clock_s;                    /* base/clock.h */
    double own_cpu_s;                  /* of this process, user and system */
    double waited_s;                   /* its threads stood ready and had no processor */
    double involuntary_switches;       /* its threads lost their processor to others */
    double machine_cpu_s;              /* of all processes, with what a hypervisor took */
    double throttled_s, thermal_count; /* by the control group; of all processors, for heat */
    double load;        /* load average of the last minute: threads that run or would like to */
    double clock_share; /* of the slowest processor: its clock over its highest */
} fm_host_load;

/* root: "" in earnest; a folder that holds proc/ and sys/ for tests. */
void host_load_read(fm_host_load *load, const char *root);

/* User and system time of this process so far. */
double host_load_own_cpu_s(void);

#endif

#include "ledger.h"

void ledger_add(fm_ledger *ledger, fm_owner owner, uint64_t bytes)
{
    ledger->bytes[owner] += bytes;
    if (ledger->bytes[owner] > ledger->peak_bytes[owner])
        ledger->peak_bytes[owner] = ledger->bytes[owner];
}

void ledger_remove(fm_ledger *ledger, fm_owner owner, uint64_t bytes)
{
    ledger->bytes[owner] -= bytes;
}

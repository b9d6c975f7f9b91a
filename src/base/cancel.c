/* cancel.c - the one flag that stops long work; see cancel.h. */
#include "base/cancel.h"

#include <stdatomic.h>

static atomic_bool requested;

void requestCancel(void)
{
    atomic_store_explicit(&requested, true, memory_order_relaxed);
}

bool cancelRequested(void)
{
    return atomic_load_explicit(&requested, memory_order_relaxed);
}

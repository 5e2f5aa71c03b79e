#pragma once
/* What interface_in_c.c, which is compiled as C99, says of the structs: C and C++ agree on them. */
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The sizes of all structs of clusterbench_plugin.h in the order in which they stand there; returns their number. */
size_t sizes_in_c(size_t* sizes, size_t most);
/* clusterbench_check_values() of a method with the parameters "a" and "b", for these names; NULL ends them. */
int check_in_c(const char* const* names, char* text, unsigned capacity);

#ifdef __cplusplus
}
#endif

// The same method, which crashes if it is not told otherwise.

#define FAULT "segv"
#define ID "always"
#include "faulty.cpp"

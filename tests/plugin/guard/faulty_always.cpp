// The same method, which crashes in assign() if it is not told otherwise.

#define FAULT "segv"
#define PLACES \
  { "assign" }
#define ID "always"
#include "faulty.cpp"

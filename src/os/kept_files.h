#pragma once
// Open files that this process needs. Foreign code in it can close them, or put others in their place.

namespace clusterbench::os {

// After the 16th nothing is noted.
void keep_file(int descriptor);
// Standard input, output and error as they are now. The first lost_file() does that, too.
void keep_standard_files();
// Before it is closed on purpose.
void release_file(int descriptor);

// A descriptor that is not what it was; -1: all are. Takes a system call for each.
int lost_file();

}  // namespace clusterbench::os

#pragma once
// Standard input, output and error as the system hands them over.

#include <string>

namespace clusterbench::os {

// A standard stream that is closed would give its number to the next file that is opened, and what is printed would go
// there: in its place stands what can be neither read nor written, and of standard error what takes all.
void keep_standard_streams();

// A file that gets larger than the system allows (`ulimit -f`) is then an error of the write that says so, and not the
// end of the process.
void report_size_limits_as_errors();

// Whether an open descriptor of this process is a file of that name, as of `merge a b >> a`.
bool is_open_file(int descriptor, const std::string& name);

}  // namespace clusterbench::os

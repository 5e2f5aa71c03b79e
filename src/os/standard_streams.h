#pragma once
// Standard input, output and error as received from the system.

#include <string>
#include <string_view>

namespace clusterbench::os {

// If a standard stream is closed, the next opened file would get its number, and printed text would go into it. So a
// placeholder is opened that can be neither read nor written, or, for standard error, one that accepts all. Text waits
// where a stream cannot take it at once; after a failed flush of std::cout, errno has the reason.
void keep_standard_streams();

// Writes all of the text, and waits for a stream that is set to O_NONBLOCK. False on failure, with errno.
bool is_written_to(int descriptor, std::string_view text);

// Makes a file that exceeds the system's size limit (`ulimit -f`) a write error, instead of the end of the process.
void report_size_limits_as_errors();

// From now on std::cout, and files named "-" or /dev/stdout, are what standard output was, and what foreign code in
// this process prints there goes to standard error. Once a process. Throws Error.
void keep_output_apart();
// The descriptor of standard output for this program's own text.
int output_descriptor();

// Whether an open descriptor of this process is a file of that name, as of `merge a b >> a`.
bool is_open_file(int descriptor, const std::string& name);

}  // namespace clusterbench::os

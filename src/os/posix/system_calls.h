#pragma once
// What Linux and macOS do in different ways: linux/system_calls.cpp, mac/system_calls.cpp. As calls of the system do,
// they return a negative number, or false, with the reason in errno.

#include <sys/types.h>

#include <cstdint>
#include <string>

namespace clusterbench::os {

// A file without a name, which other programs do not inherit: nothing can remain of it.
int memory_file();

// Ends that other programs do not inherit: of a pipe (to read from, to write to); of a socket, with both ways.
int closing_pipe(int ends[2]);
int closing_socket_pair(int ends[2]);
// Sends bytes, without a signal where nobody reads them any more.
ssize_t send_quietly(int socket, const void* bytes, std::size_t count);

// Flushes to the disk itself.
int flush_to_disk(int file);

// Reserves room behind `size`, the end of a file, which may then be longer. Returns 0, or the reason.
int reserve_room(int file, off_t size, off_t bytes);

// In a new process: it is killed when `parent` ends. False if that one has ended already. macOS has no such call: a
// process that reads its input ends with it, and others end by themselves.
bool end_with_parent(pid_t parent);

// The path of a descriptor of this process, by which a child can open it; "" where there is none.
std::string path_for_children(int descriptor);

// The processors that this thread may run on: "0 1 2"; "" where nobody can say.
std::string allowed_processors();

// "SIGSEGV"; "" without a name.
std::string name_of_signal(int number);

}  // namespace clusterbench::os

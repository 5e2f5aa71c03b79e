#include "os/posix/system_calls.h"

#include <crt_externs.h>
#include <fcntl.h>
#include <libproc.h>
#include <malloc/malloc.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

#include "os/guarded_memory.h"
#include "os/process.h"

namespace clusterbench::os {
namespace {

// Between the call that makes a descriptor and this one a fork of another thread would inherit it: this program starts
// others from one thread.
bool close_on_exec(int descriptor) {
  return ::fcntl(descriptor, F_SETFD, FD_CLOEXEC) == 0;
}

int closing_ends(int made, int ends[2]) {
  if (made != 0) return made;
  return close_on_exec(ends[0]) && close_on_exec(ends[1]) ? 0 : -1;
}

}  // namespace

int memory_file() {
  const char* folder = ::getenv("TMPDIR");
  std::string name = std::string(folder == nullptr ? "/tmp" : folder) + "/clusterbench.XXXXXX";
  const int file = ::mkstemp(name.data());
  if (file < 0) return file;
  ::unlink(name.c_str());
  close_on_exec(file);
  return file;
}

int closing_pipe(int ends[2]) {
  return closing_ends(::pipe(ends), ends);
}

int closing_socket_pair(int ends[2]) {
  return closing_ends(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends), ends);
}

ssize_t send_quietly(int socket, const void* bytes, std::size_t count) {
  const int on = 1;
  ::setsockopt(socket, SOL_SOCKET, SO_NOSIGPIPE, &on, sizeof on);
  return ::send(socket, bytes, count, 0);
}

// fsync() leaves the bytes in the disk's own cache.
int flush_to_disk(int file) {
  return ::fcntl(file, F_FULLFSYNC) == 0 ? 0 : ::fsync(file);
}

int reserve_room(int file, off_t size, off_t bytes) {
  fstore_t room{F_ALLOCATEALL, F_PEOFPOSMODE, 0, bytes, 0};
  if (::fcntl(file, F_PREALLOCATE, &room) != 0) return errno;
  return ::ftruncate(file, size + bytes) == 0 ? 0 : errno;
}

bool end_with_parent(pid_t parent) {
  return ::getppid() == parent;
}

std::string path_for_children(int) {
  return "";
}

std::string allowed_processors() {
  return "";
}

std::string name_of_signal(int number) {
  if (number <= 0 || number >= NSIG || sys_signame[number] == nullptr) return "";
  std::string name = "SIG";
  for (const char* at = sys_signame[number]; *at != '\0'; ++at)
    name += static_cast<char>(*at >= 'a' && *at <= 'z' ? *at - 'a' + 'A' : *at);
  return name;
}

const std::string& this_program() {
  static const std::string path = [] {
    std::array<char, PROC_PIDPATHINFO_MAXSIZE> text{};
    const int bytes = ::proc_pidpath(::getpid(), text.data(), text.size());
    return bytes > 0 ? std::string(text.data(), static_cast<std::size_t>(bytes)) : std::string("clusterbench");
  }();
  return path;
}

std::string this_program_for_others() {
  return this_program();
}

std::vector<std::string> own_command_line() {
  char** const words = *::_NSGetArgv();
  return {words, words + *::_NSGetArgc()};
}

std::size_t heap_in_use() {
  return ::mstats().bytes_used;
}

}  // namespace clusterbench::os

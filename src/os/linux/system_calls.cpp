#include "os/posix/system_calls.h"

#include <fcntl.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <fstream>

#include "os/guarded_memory.h"
#include "os/process.h"

#include <malloc.h>

namespace clusterbench::os {

int memory_file() {
  return ::memfd_create("clusterbench", MFD_CLOEXEC);
}

int closing_pipe(int ends[2]) {
  return ::pipe2(ends, O_CLOEXEC);
}

int closing_socket_pair(int ends[2]) {
  return ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends);
}

ssize_t send_quietly(int socket, const void* bytes, std::size_t count) {
  return ::send(socket, bytes, count, MSG_NOSIGNAL);
}

int flush_to_disk(int file) {
  return ::fsync(file);
}

int reserve_room(int file, off_t size, off_t bytes) {
  return ::posix_fallocate(file, size, bytes);
}

bool end_with_parent(pid_t parent) {
  return ::prctl(PR_SET_PDEATHSIG, SIGKILL) == 0 && ::getppid() == parent;
}

std::string path_for_children(int descriptor) {
  return "/proc/" + std::to_string(::getpid()) + "/fd/" + std::to_string(descriptor);
}

std::string allowed_processors() {
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  if (::sched_getaffinity(0, sizeof allowed, &allowed) != 0) return "";
  std::string text;
  for (int i = 0; i < CPU_SETSIZE; ++i)
    if (CPU_ISSET(i, &allowed)) text += (text.empty() ? "" : " ") + std::to_string(i);
  return text;
}

std::string name_of_signal(int number) {
  const char* name = ::sigabbrev_np(number);
  return name == nullptr ? "" : std::string("SIG") + name;
}

// The kernel keeps the file for as long as the process runs, whatever has its name now.
const std::string& this_program() {
  static const std::string path = "/proc/self/exe";
  return path;
}

std::string this_program_for_others() {
  return "/proc/" + std::to_string(::getpid()) + "/exe";
}

std::vector<std::string> own_command_line() {
  std::ifstream in("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> words;
  for (std::string word; std::getline(in, word, '\0');) words.push_back(word);
  return words;
}

std::size_t heap_in_use() {
  const struct mallinfo2 facts = ::mallinfo2();
  return facts.uordblks + facts.hblkhd;
}

}  // namespace clusterbench::os

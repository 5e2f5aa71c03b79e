#include "os/process.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>

#include "core/error.h"
#include "os/windows/command_words.h"
#include "os/windows/windows_api.h"

namespace clusterbench::os {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse_start(const std::string& program, const std::string& action) {
  take_last_error();
  throw Error(program, "", errno_text(action), ExitCode::internal);
}

// All children are in one job, which Windows ends with the last handle to it: with this process. nullptr if there is
// none; then a child ends with its input.
HANDLE job_of_children() {
  static const HANDLE job = [] {
    const HANDLE made = ::CreateJobObjectW(nullptr, nullptr);
    JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits{};
    limits.BasicLimitInformation.LimitFlags = JOB_OBJECT_LIMIT_KILL_ON_JOB_CLOSE;
    ::SetInformationJobObject(made, JobObjectExtendedLimitInformation, &limits, sizeof limits);
    return made;
  }();
  return job;
}

// The standard streams of a new process.
using Streams = std::array<HANDLE, 3>;

// What a new process inherits: these handles and no others.
class InheritedHandles {
 public:
  explicit InheritedHandles(Streams& streams) {
    SIZE_T bytes = 0;
    ::InitializeProcThreadAttributeList(nullptr, 1, 0, &bytes);
    memory_.resize(bytes);
    if (::InitializeProcThreadAttributeList(list(), 1, 0, &bytes) == 0) return;
    for (const HANDLE stream : streams) ::SetHandleInformation(stream, HANDLE_FLAG_INHERIT, HANDLE_FLAG_INHERIT);
    is_made_ = ::UpdateProcThreadAttribute(list(), 0, PROC_THREAD_ATTRIBUTE_HANDLE_LIST, streams.data(),
                                           streams.size() * sizeof(HANDLE), nullptr, nullptr) != 0;
  }
  ~InheritedHandles() {
    if (!memory_.empty()) ::DeleteProcThreadAttributeList(list());
  }
  InheritedHandles(const InheritedHandles&) = delete;
  InheritedHandles& operator=(const InheritedHandles&) = delete;

  bool is_made() const { return is_made_; }
  LPPROC_THREAD_ATTRIBUTE_LIST list() { return reinterpret_cast<LPPROC_THREAD_ATTRIBUTE_LIST>(memory_.data()); }

 private:
  std::vector<char> memory_;
  bool is_made_ = false;
};

struct Started {
  OwnedHandle process;
  DWORD error = 0;  // why there is none
};

Started start(const std::vector<std::string>& command, Streams streams) {
  InheritedHandles inherited(streams);
  if (!inherited.is_made()) return {OwnedHandle(), ::GetLastError()};
  STARTUPINFOEXW facts{};
  facts.StartupInfo.cb = sizeof facts;
  facts.StartupInfo.dwFlags = STARTF_USESTDHANDLES;
  facts.StartupInfo.hStdInput = streams[0];
  facts.StartupInfo.hStdOutput = streams[1];
  facts.StartupInfo.hStdError = streams[2];
  facts.lpAttributeList = inherited.list();
  std::wstring text = command_text(command);
  PROCESS_INFORMATION made{};
  constexpr DWORD k_way = EXTENDED_STARTUPINFO_PRESENT | CREATE_SUSPENDED | CREATE_UNICODE_ENVIRONMENT;
  if (::CreateProcessW(nullptr, text.data(), nullptr, nullptr, TRUE, k_way, nullptr, nullptr, &facts.StartupInfo,
                       &made) == 0)
    return {OwnedHandle(), ::GetLastError()};
  const OwnedHandle thread(made.hThread);
  ::AssignProcessToJobObject(job_of_children(), made.hProcess);
  ::ResumeThread(thread.get());
  return {OwnedHandle(made.hProcess), 0};
}

std::string start_error_text(DWORD error) {
  ::SetLastError(error);
  take_last_error();
  return errno_text("cannot be started");
}

const char* name_of_exception(DWORD code) {
  switch (code) {
    case EXCEPTION_ACCESS_VIOLATION:
      return "an access to memory that is not its own";
    case EXCEPTION_ILLEGAL_INSTRUCTION:
      return "an instruction that this processor does not have";
    case EXCEPTION_STACK_OVERFLOW:
      return "its stack is full";
    case EXCEPTION_INT_DIVIDE_BY_ZERO:
      return "a division by zero";
    case STATUS_CONTROL_C_EXIT:
      return "Ctrl-C";
    default:
      return "";
  }
}

// Exceptions that nobody takes become exit codes from 0xC0000000 on.
Ending ending_of(DWORD code, const MemoryFile& errors) {
  const int number = static_cast<int>(code);
  if (code < 0xC0000000) return {code == 0 ? "" : "exit code " + std::to_string(code), number, number, errors.tail()};
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "exception 0x%08lX", code);
  const std::string name = name_of_exception(code);
  return {text.data() + (name.empty() ? "" : " (" + name + ")"), -1, number, errors.tail()};
}

Ending wait_for(HANDLE process, const MemoryFile& errors) {
  ::WaitForSingleObject(process, INFINITE);
  DWORD code = 0;
  ::GetExitCodeProcess(process, &code);
  return ending_of(code, errors);
}

// A pipe with an end of ours, which can be waited for, and an end for a child.
struct OutputPipe {
  OwnedHandle ours, theirs;
};

OutputPipe output_pipe(const std::string& program) {
  static std::atomic<int> count{0};
  const std::wstring name = L"\\\\.\\pipe\\clusterbench." + std::to_wstring(::GetCurrentProcessId()) + L"." +
                            std::to_wstring(count.fetch_add(1));
  constexpr DWORD k_bytes = 1 << 16;
  OutputPipe pipe{OwnedHandle(::CreateNamedPipeW(
                      name.c_str(), PIPE_ACCESS_INBOUND | FILE_FLAG_OVERLAPPED | FILE_FLAG_FIRST_PIPE_INSTANCE,
                      PIPE_TYPE_BYTE | PIPE_WAIT | PIPE_REJECT_REMOTE_CLIENTS, 1, k_bytes, k_bytes, 0, nullptr)),
                  OwnedHandle(::CreateFileW(name.c_str(), GENERIC_WRITE, 0, nullptr, OPEN_EXISTING, 0, nullptr))};
  if (!pipe.ours.is_open() || !pipe.theirs.is_open()) refuse_start(program, "no pipe for its output");
  return pipe;
}

enum class PipeRead { some, nothing, end };

// Waits at most 100 ms for bytes, and adds them to `text`.
PipeRead read_pipe(HANDLE pipe, std::string& text) {
  constexpr DWORD k_wait_ms = 100;
  std::array<char, 1 << 16> some{};
  const OwnedHandle event(::CreateEventW(nullptr, TRUE, FALSE, nullptr));
  OVERLAPPED reading{};
  reading.hEvent = event.get();
  const bool has_begun = ::ReadFile(pipe, some.data(), static_cast<DWORD>(some.size()), nullptr, &reading) != 0 ||
                         ::GetLastError() == ERROR_IO_PENDING;
  if (!has_begun) return PipeRead::end;
  if (::WaitForSingleObject(event.get(), k_wait_ms) == WAIT_TIMEOUT) ::CancelIoEx(pipe, &reading);
  DWORD bytes = 0;
  const bool is_done = ::GetOverlappedResult(pipe, &reading, &bytes, TRUE) != 0;
  text.append(some.data(), bytes);
  if (is_done) return bytes > 0 ? PipeRead::some : PipeRead::nothing;
  return ::GetLastError() == ERROR_OPERATION_ABORTED ? PipeRead::nothing : PipeRead::end;
}

class Child {
 public:
  Child(const std::vector<std::string>& command, const std::string& input) : input_(input) {
    OutputPipe pipe = output_pipe(command.front());
    started_ = start(command, {handle_of(input_.descriptor()), pipe.theirs.get(), handle_of(errors_.descriptor())});
    out_ = std::move(pipe.ours);
  }
  ~Child() {
    terminate();
    if (is_running()) ::WaitForSingleObject(started_.process.get(), INFINITE);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  // False at the end of its output.
  bool read(std::string& text) const { return read_pipe(out_.get(), text) != PipeRead::end; }

  // It has no data to save: what asks for it keeps its output.
  void terminate() const {
    if (is_running()) ::TerminateProcess(started_.process.get(), static_cast<UINT>(ExitCode::interrupted));
  }

  Ending end() {
    if (started_.error != 0) return {start_error_text(started_.error), -1, -1, ""};
    has_ended_ = true;
    return wait_for(started_.process.get(), errors_);
  }

 private:
  bool is_running() const { return started_.error == 0 && !has_ended_; }

  MemoryFile input_, errors_;
  Started started_;
  OwnedHandle out_;
  bool has_ended_ = false;
};

fs::path path_of_this_program() {
  std::wstring text(1 << 15, L'\0');
  text.resize(::GetModuleFileNameW(nullptr, text.data(), static_cast<DWORD>(text.size())));
  return text;
}

void close_number(std::intptr_t& number) {
  if (number != -1) ::CloseHandle(handle_of(number));
  number = -1;
}

}  // namespace

// A program that runs can be neither replaced nor removed.
const std::string& this_program() {
  static const std::string path = path_of_this_program().string();
  return path;
}

std::string this_program_for_others() {
  return this_program();
}

std::vector<std::string> own_command_line() {
  return words_of(::GetCommandLineW());
}

// Windows keeps a temporary file in memory while there is room, and removes it with its last handle.
MemoryFile::MemoryFile(const std::string& text) {
  static std::atomic<int> count{0};
  std::error_code failed;
  const fs::path file = fs::temp_directory_path(failed) / (L"clusterbench." + std::to_wstring(::GetCurrentProcessId()) +
                                                           L"." + std::to_wstring(count.fetch_add(1)) + L".tmp");
  descriptor_ = number_of(::CreateFileW(file.c_str(), GENERIC_READ | GENERIC_WRITE,
                                        FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, nullptr, CREATE_ALWAYS,
                                        FILE_ATTRIBUTE_TEMPORARY | FILE_FLAG_DELETE_ON_CLOSE, nullptr));
  if (descriptor_ == -1) refuse_start(file.string(), "no temporary file could be made");
  if (!write_all_to(handle_of(descriptor_), text)) {
    close_number(descriptor_);
    refuse_start(file.string(), "a temporary file could not be written");
  }
  ::SetFilePointer(handle_of(descriptor_), 0, nullptr, FILE_BEGIN);
}

MemoryFile::~MemoryFile() {
  close_number(descriptor_);
}

// Through a handle of its own: the other one's position is where the child writes.
std::string MemoryFile::tail() const {
  constexpr std::int64_t k_most = 2000;
  const OwnedHandle again(
      ::ReOpenFile(handle_of(descriptor_), GENERIC_READ, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, 0));
  LARGE_INTEGER size{}, begin{};
  if (!again.is_open() || ::GetFileSizeEx(again.get(), &size) == 0) return "";
  begin.QuadPart = std::max<std::int64_t>(0, size.QuadPart - k_most);
  std::string text(static_cast<std::size_t>(size.QuadPart - begin.QuadPart), '\0');
  DWORD bytes = 0;
  ::SetFilePointerEx(again.get(), begin, nullptr, FILE_BEGIN);
  ::ReadFile(again.get(), text.data(), static_cast<DWORD>(text.size()), &bytes, nullptr);
  text.resize(bytes);
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
  return (begin.QuadPart > 0 ? "..." : "") + text;
}

Ending run_child(const std::vector<std::string>& command, const std::string& input,
                 const std::function<void(const std::string& line)>& on_line, const std::atomic<bool>& stop) {
  Child child(command, input);
  std::string text;
  while (!stop && child.read(text))
    for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n')) {
      on_line(text.substr(0, end));
      text.erase(0, end + 1);
    }
  if (stop) child.terminate();
  return child.end();
}

Conversation::Conversation(const std::vector<std::string>& command) {
  OutputPipe output = output_pipe(command.front());
  HANDLE input[2]{};
  if (::CreatePipe(&input[0], &input[1], nullptr, 0) == 0) refuse_start(command.front(), "no pipe to talk to it");
  const OwnedHandle theirs(input[0]);
  OwnedHandle ours(input[1]);
  Started started = start(command, {theirs.get(), output.theirs.get(), handle_of(errors_.descriptor())});
  if (started.error != 0) throw Error(command.front(), "", start_error_text(started.error));
  to_ = number_of(ours.release());
  from_ = number_of(output.ours.release());
  process_ = number_of(started.process.release());
}

Conversation::~Conversation() {
  end();
  close_number(from_);
}

void Conversation::send_line(const std::string& line) {
  write_all_to(handle_of(to_), line + "\n");
}

Conversation::Received Conversation::receive_line(std::string& line, double seconds, const std::atomic<bool>& stop) {
  const auto start = std::chrono::steady_clock::now();
  for (std::size_t searched = 0;;) {
    if (const std::size_t end = received_.find('\n', searched); end != std::string::npos) {
      line = received_.substr(0, end);
      received_.erase(0, end + 1);
      return Received::line;
    }
    searched = received_.size();
    const PipeRead read = read_pipe(handle_of(from_), received_);
    if (stop) return Received::stop;
    if (std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() > seconds)
      return Received::timeout;
    if (read == PipeRead::end) return Received::end;
  }
}

Ending Conversation::end() {
  constexpr DWORD k_wait_ms = 200;
  if (process_ == -1) return ending_;
  close_number(to_);  // a program that reads it ends by itself
  if (::WaitForSingleObject(handle_of(process_), k_wait_ms) == WAIT_TIMEOUT)
    ::TerminateProcess(handle_of(process_), static_cast<UINT>(ExitCode::interrupted));
  ending_ = wait_for(handle_of(process_), errors_);
  close_number(process_);
  return ending_;
}

}  // namespace clusterbench::os

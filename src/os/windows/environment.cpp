#include "os/environment.h"

#include <sstream>

#include "os/process.h"
#include "os/windows/windows_api.h"

namespace clusterbench::os {

std::optional<std::string> variable(const std::string& name) {
  const std::wstring wide_name = wide(name);
  ::SetLastError(ERROR_SUCCESS);
  const DWORD size = ::GetEnvironmentVariableW(wide_name.c_str(), nullptr, 0);
  if (size == 0) return ::GetLastError() == ERROR_ENVVAR_NOT_FOUND ? std::nullopt : std::optional<std::string>("");
  std::wstring value(size, L'\0');
  value.resize(::GetEnvironmentVariableW(wide_name.c_str(), value.data(), size));
  return narrow(value);
}

std::vector<std::string> environment_variables() {
  std::vector<std::string> all;
  wchar_t* const block = ::GetEnvironmentStringsW();
  for (const wchar_t* one = block; one != nullptr && *one != L'\0'; one += std::wstring(one).size() + 1)
    all.push_back(narrow(one));
  if (block != nullptr) ::FreeEnvironmentStringsW(block);
  return all;
}

std::vector<std::string> folders_in_variable(const std::string& name) {
  std::istringstream list(variable(name).value_or(""));
  std::vector<std::string> folders;
  for (std::string folder; std::getline(list, folder, ';');)
    if (!folder.empty()) folders.push_back(folder);
  return folders;
}

// They stay until the process ends, as those of the system do.
void take_arguments(int& count, char**& arguments) {
  static std::vector<std::string> words = own_command_line();
  static std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  count = static_cast<int>(pointers.size());
  pointers.push_back(nullptr);
  arguments = pointers.data();
}

}  // namespace clusterbench::os

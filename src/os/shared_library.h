#pragma once
// Code in a file of its own, loaded into this process. It stays until the process ends.

#include <filesystem>
#include <string>
#include <string_view>

namespace clusterbench::os {

// Why this file's content cannot be a shared library of this machine, as the end of a sentence whose subject is the
// file: "is no shared library". "" if it can be one.
std::string library_obstacle(std::string_view content);

// Loads a file, whose code then runs (its constructors). Twice the same file is one library. Throws Error, which names
// the file and says what is missing.
class SharedLibrary {
 public:
  explicit SharedLibrary(const std::filesystem::path& file);

  // The address of an exported symbol; null if there is none of that name.
  void* symbol(const char* name) const;

 private:
  void* handle_;
};

// The address of an exported symbol of a library that is in this process already, by the library's name without what a
// system adds: "renderdoc" is librenderdoc.so, librenderdoc.dylib or renderdoc.dll. Null if it is not there.
void* symbol_of_loaded(const std::string& library, const char* symbol);

}  // namespace clusterbench::os

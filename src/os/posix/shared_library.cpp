#include "os/shared_library.h"

#include <dlfcn.h>

#include "core/error.h"

namespace clusterbench::os {
SharedLibrary::SharedLibrary(const std::filesystem::path& file)
    : handle_(dlopen(std::filesystem::absolute(file).c_str(), RTLD_NOW | RTLD_LOCAL)) {
  if (handle_ != nullptr) return;
  const char* text = dlerror();
  std::string reason = text == nullptr ? "no reason is known" : text;
  if (const std::string named = std::filesystem::absolute(file).string() + ": "; reason.starts_with(named))
    reason.erase(0, named.size());
  throw Error(file.string(), "", "cannot be loaded: " + reason);
}

void* SharedLibrary::symbol(const char* name) const {
  return dlsym(handle_, name);
}

void* symbol_of_loaded(const std::string& library, const char* symbol) {
  for (const char* ending : {".so", ".dylib"}) {
    void* handle = dlopen(("lib" + library + ending).c_str(), RTLD_NOW | RTLD_NOLOAD);
    if (handle != nullptr) return dlsym(handle, symbol);
  }
  return nullptr;
}

}  // namespace clusterbench::os

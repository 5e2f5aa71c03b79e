#include "os/shared_library.h"

#include "core/error.h"
#include "os/windows/windows_api.h"

namespace clusterbench::os {

// Its own libraries are searched beside it, and never in the current folder.
SharedLibrary::SharedLibrary(const std::filesystem::path& file)
    : handle_(::LoadLibraryExW(std::filesystem::absolute(file).make_preferred().c_str(), nullptr,
                               LOAD_LIBRARY_SEARCH_DLL_LOAD_DIR | LOAD_LIBRARY_SEARCH_DEFAULT_DIRS)) {
  if (handle_ == nullptr) throw Error(file.string(), "", windows_error_text("cannot be loaded", ::GetLastError()));
}

void* SharedLibrary::symbol(const char* name) const {
  return reinterpret_cast<void*>(::GetProcAddress(static_cast<HMODULE>(handle_), name));
}

void* symbol_of_loaded(const std::string& library, const char* symbol) {
  const HMODULE loaded = ::GetModuleHandleA((library + ".dll").c_str());
  return loaded == nullptr ? nullptr : reinterpret_cast<void*>(::GetProcAddress(loaded, symbol));
}

}  // namespace clusterbench::os

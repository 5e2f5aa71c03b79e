#include "plugin/plugin_call.h"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string_view>
#include <typeinfo>

#if __has_include(<cxxabi.h>)
#include <cxxabi.h>
#endif

#include "core/text.h"

namespace clusterbench::plugin {
namespace {

// Of a text of a plug-in, which can be without end.
std::string cut(const char* text) {
  constexpr std::size_t k_longest = 1000;
  if (text == nullptr) return "";
  std::size_t length = 0;
  while (length < k_longest && text[length] != '\0') ++length;
  return printable(std::string_view(text, length));
}

// "of the type std::out_of_range"; "" where that is not known.
std::string type_text() {
#if __has_include(<cxxabi.h>)
  const std::type_info* type = abi::__cxa_current_exception_type();
  if (type == nullptr) return "";
  int status = 0;
  char* name = abi::__cxa_demangle(type->name(), nullptr, nullptr, &status);
  std::string text = "of the type " + cut(name == nullptr ? type->name() : name);
  std::free(name);
  return text;
#else
  return "";
#endif
}

}  // namespace

std::string exception_text() {
  std::string text;
  try {
    throw;
  } catch (const std::exception& error) {
    text = cut(error.what());
    if (text.empty()) text = type_text();
  } catch (...) {
    text = type_text();
  }
  return text.empty() ? "of no known type" : text;
}

void end_as_left(const char* doing, const std::string& exception) {
  std::fprintf(stderr, "clusterbench: an exception left %s: %s\n", doing, exception.c_str());
  std::abort();
}

}  // namespace clusterbench::plugin

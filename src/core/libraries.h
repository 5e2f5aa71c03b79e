#pragma once
// The optional libraries of this build: which are there, and what a user is told where one is not.

#include <span>
#include <string>
#include <string_view>

namespace clusterbench {

enum class Library : int {
  embree,
  libpng,
  nlopt,
  openssl,
  re2,
  valijson,
  onetbb,
  meshoptimizer,
  draco,
  vulkan,
  spirv_tools,
  page,  // Node.js, which bundles it when the program is built
};

struct OptionalLibrary {
  Library library;
  const char* name;
  const char* serves;   // what needs it
  const char* without;  // what happens where it is missing
  bool is_built_in;
};

// All of them, in the order of `Library`.
std::span<const OptionalLibrary> optional_libraries();
bool is_built_in(Library library);

// "this clusterbench was built without Embree": the reason for a case under `skipped` in the result of such a build.
std::string built_without(Library library);
// The same of this build; "" if the library is built in.
std::string missing_library(Library library);
// Throws Error with `option` as its location if the library is missing: "--images: pictures need libpng, and this
// clusterbench was built without it".
void need_library(Library library, const std::string& option, std::string_view purpose);

}  // namespace clusterbench

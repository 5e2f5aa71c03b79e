// cmake/ClusterbenchLibraries.cmake defines CLUSTERBENCH_HAS_NAME as 0 or 1, for this file and those that use one.

#include "core/libraries.h"

#include <string>

#include "core/error.h"

namespace clusterbench {
namespace {

constexpr OptionalLibrary k_libraries[] = {
    {Library::embree, "Embree", "visible surfaces, depth buffers, shadows and visible sets",
     "methods, samples and slices that need them are skipped", CLUSTERBENCH_HAS_EMBREE},
    {Library::libpng, "libpng", "--images", "--images is refused", CLUSTERBENCH_HAS_PNG},
    {Library::nlopt, "NLopt", "the search for the worst frame", "worst-case is refused, and size searches no frames",
     CLUSTERBENCH_HAS_NLOPT},
    {Library::openssl, "OpenSSL", "SHA-256", "the program's own SHA-256, which is slower", CLUSTERBENCH_HAS_OPENSSL},
    {Library::re2, "RE2", "regular expressions", "the program's own matcher", CLUSTERBENCH_HAS_RE2},
    {Library::valijson, "valijson", "documents against their schema", "the program's own validator",
     CLUSTERBENCH_HAS_VALIJSON},
    {Library::onetbb, "oneTBB", "threads", "threads of the standard library", CLUSTERBENCH_HAS_TBB},
    {Library::meshoptimizer, "meshoptimizer", "scenes that gltfpack compressed", "such scenes are refused",
     CLUSTERBENCH_HAS_MESHOPTIMIZER},
    {Library::draco, "Draco", "scenes that Draco compressed", "such scenes are refused", CLUSTERBENCH_HAS_DRACO},
    {Library::vulkan, "Vulkan", "methods on the GPU", "such methods are skipped", CLUSTERBENCH_HAS_VULKAN},
    {Library::spirv_tools, "SPIRV-Tools", "all rules of SPIR-V for users' shaders", "only their structure is checked",
     CLUSTERBENCH_HAS_SPIRV_TOOLS},
    {Library::page, "Node.js", "the pages of report, history show and check", "the pages are refused",
     CLUSTERBENCH_HAS_NODE},
};

const OptionalLibrary& row_of(Library library) {
  return k_libraries[static_cast<int>(library)];
}

}  // namespace

std::span<const OptionalLibrary> optional_libraries() {
  return k_libraries;
}

bool is_built_in(Library library) {
  return row_of(library).is_built_in;
}

std::string built_without(Library library) {
  return std::string("this clusterbench was built without ") + row_of(library).name;
}

std::string missing_library(Library library) {
  return is_built_in(library) ? "" : built_without(library);
}

void need_library(Library library, const std::string& option, std::string_view purpose) {
  if (is_built_in(library)) return;
  throw Error("", option,
              std::string(purpose) + " need " + row_of(library).name + ", and this clusterbench was built without it");
}

}  // namespace clusterbench

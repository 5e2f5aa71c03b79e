// Files as text: streams that never end, and files beyond the limit on memory.

#include "core/file_text.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>

#include "core/error.h"
#include "core/memory.h"

namespace clusterbench {
namespace {

std::string refusal(const std::filesystem::path& path) {
  try {
    static_cast<void>(file_text(path));
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(FileText, a_device_that_never_ends_is_refused) {
  EXPECT_EQ(refusal("/dev/zero"), "/dev/zero: byte 0: is a NUL byte, and only text is read from a stream");
  EXPECT_EQ(file_text("/dev/null"), "");
}

TEST(FileText, a_file_longer_than_the_limit_on_memory_is_refused) {
  const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "file_text_test";
  std::ofstream(path) << std::string(3 << 20, ' ');
  {
    const MemoryLimitScope limit(std::uint64_t{2} << 20);
    EXPECT_EQ(refusal(path), path.string() + ": is longer than 2 MiB, the limit on memory (limits.memory_mib)");
  }
  EXPECT_EQ(file_text(path).size(), std::size_t{3} << 20);
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace clusterbench

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/memory.h"
#include "core/random.h"
#include "dump/made_dump.h"
#include "effort.h"

namespace clusterbench::dump {
namespace {

using namespace testing;

// Numbers that break arithmetic where it is not checked.
constexpr const char* k_numbers[] = {
    "0",   "1",    "3",     "-1", "4294967295", "18446744073709551615", "9223372036854775808", "1e308", "1e-308",
    "0.5", "null", "65536", "[]", "\"u16\""};

// The text with a number in place of one of its own.
std::string with_other_number(const std::string& text, SplitMix64& random) {
  std::vector<std::pair<std::size_t, std::size_t>> places;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (std::isdigit(static_cast<unsigned char>(text[i])) == 0) continue;
    std::size_t end = i;
    while (end < text.size() && std::string("0123456789.e-+").find(text[end]) != std::string::npos) ++end;
    places.emplace_back(i, end - i);
    i = end;
  }
  const auto& [at, size] = places[random.next() % places.size()];
  std::string out = text;
  return out.replace(at, size, k_numbers[random.next() % std::size(k_numbers)]);
}

TEST(MangledDumps, are_judged_or_refused_with_a_place) {
  Made made = made_frame({{0, 0}, {4, 3}, 0.0});
  made.frame.lights.resize(40);
  made.frame.count_types();
  made.truth = measure::find_truth(made.frame, made.grid, 1).lists;
  const MemoryLimitScope limit(std::uint64_t{16} << 20);
  int judged = 0, refused = 0;
  SplitMix64 random(11);
  for (const char* storage : {"packed", "fixed", "bitfield", "linked", "runs"}) {
    const MadeDump right = make_dump(made.frame, made.grid, described(made.truth, made.frame.ranges(), storage));
    const std::string text = result::to_json(right.record).dump();
    for (int i = 0; i < test::tries(200); ++i) {
      std::vector<layout::Buffer> buffers = right.buffers;
      for (int change = 0; change < 3; ++change) {
        std::vector<std::byte>& bytes = buffers[random.next() % buffers.size()].bytes;
        if (!bytes.empty()) bytes[random.next() % bytes.size()] = static_cast<std::byte>(random.next());
      }
      try {
        const std::string mangled = random.unit() < 0.8 ? with_other_number(text, random) : text;
        const DumpFile dump{"made.json", parse_dump(mangled, "made.json"), std::move(buffers)};
        if (frame_of(dump).grid.cell_count() > 20000) continue;
        EXPECT_FALSE(check_text(judge(dump, {}), 5).empty());
        ++judged;
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::usage) << error.what();
        EXPECT_FALSE(error.file().empty()) << error.what();
        EXPECT_FALSE(error.where().empty()) << error.what();
        ++refused;
      }
    }
  }
  EXPECT_GT(judged, 10);
  EXPECT_GT(refused, 10);
}

}  // namespace
}  // namespace clusterbench::dump

#include "os/processor.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

namespace clusterbench::os {
namespace {

Processor processor_in(const std::string& cpuinfo) {
  std::istringstream in(cpuinfo);
  return processor_of(in);
}

TEST(Processor, of_two_with_one_name_differ_by_family_model_and_stepping) {
  const Processor first = processor_in(
      "processor\t: 0\nvendor_id\t: AuthenticAMD\ncpu family\t: 26\nmodel\t\t: 2\nmodel name\t: AMD EPYC\n"
      "stepping\t: 1\n\nprocessor\t: 1\nmodel\t\t: 9\n");
  EXPECT_EQ(first.name, "AMD EPYC");
  EXPECT_EQ(first.family, "26");
  EXPECT_EQ(first.model, "2");
  EXPECT_EQ(first.stepping, "1");
}

TEST(Processor, of_arm_is_named_by_implementer_and_part) {
  const std::string start = "processor\t: 0\nBogoMIPS\t: 243.75\nCPU implementer\t: 0x41\nCPU variant\t: 0x3\n";
  const Processor known = processor_in(start + "CPU part\t: 0xd0c\nCPU revision\t: 1\n");
  EXPECT_EQ(known.name, "Arm Neoverse-N1");
  EXPECT_EQ(known.model, "0xd0c");
  EXPECT_EQ(known.stepping, "r3p1");
  EXPECT_EQ(processor_in(start + "CPU part\t: 0xfff\n").name, "ARM implementer 0x41 part 0xfff");
}

TEST(Processor, that_says_nothing_is_unknown) {
  EXPECT_EQ(processor_in("").name, "unknown");
  EXPECT_EQ(processor_in("hart : 1\n").family, "");
}

TEST(Processor, tells_its_clock_where_the_system_does) {
  namespace fs = std::filesystem;
  std::istringstream two("processor : 0\ncpu MHz\t\t: 2000.5\n\nprocessor : 1\ncpu MHz\t\t: 3000.5\n"),
      none("hart : 1\n"), again("hart : 1\n");
  const fs::path folder = fs::temp_directory_path() / ("clusterbench_clock_" + std::to_string(getpid()));
  EXPECT_DOUBLE_EQ(clock_of(two, folder)->now_mhz, 2500.5);
  EXPECT_FALSE(clock_of(none, folder));
  fs::create_directories(folder);
  std::ofstream(folder / "scaling_cur_freq") << "1800000\n";
  std::ofstream(folder / "cpuinfo_max_freq") << "3400000\n";
  const std::optional<Clock> clock = clock_of(again, folder);
  fs::remove_all(folder);
  ASSERT_TRUE(clock);
  EXPECT_DOUBLE_EQ(clock->now_mhz, 1800.0);
  EXPECT_DOUBLE_EQ(*clock->most_mhz, 3400.0);
}

TEST(Processor, load_is_the_mean_of_the_last_minute) {
  std::istringstream some("0.52 0.58 0.59 1/467 12345\n"), none("");
  EXPECT_DOUBLE_EQ(*load_of(some), 0.52);
  EXPECT_FALSE(load_of(none));
}

TEST(Processor, has_the_caches_that_its_folder_lists) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / ("clusterbench_caches_" + std::to_string(getpid()));
  const auto add = [&](const std::string& index, const char* level, const char* type, const char* size) {
    fs::create_directories(folder / index);
    std::ofstream(folder / index / "level") << level << "\n";
    std::ofstream(folder / index / "type") << type << "\n";
    std::ofstream(folder / index / "size") << size << "\n";
  };
  add("index0", "1", "Data", "48K");
  add("index1", "1", "Instruction", "32K");
  add("index2", "2", "Unified", "1M");
  const std::vector<std::pair<std::string, std::uint64_t>> expected{{"l1d", 49152}, {"l1i", 32768}, {"l2", 1u << 20}};
  EXPECT_EQ(caches_of(folder), expected);
  fs::remove_all(folder);
  EXPECT_TRUE(caches_of(folder).empty());
}

}  // namespace
}  // namespace clusterbench::os

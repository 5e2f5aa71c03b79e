#include "os/processor.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string_view>

#include "os/processor_time.h"

namespace clusterbench::os {
namespace {

std::string trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t"), end = text.find_last_not_of(" \t");
  return begin == std::string_view::npos ? "" : std::string(text.substr(begin, end - begin + 1));
}

std::map<std::string, std::string> first_processor(std::istream& cpuinfo) {
  std::map<std::string, std::string> fields;
  for (std::string line; std::getline(cpuinfo, line) && !(line.empty() && !fields.empty());)
    if (const std::size_t colon = line.find(':'); colon != std::string::npos)
      fields[trimmed(line.substr(0, colon))] = trimmed(line.substr(colon + 1));
  return fields;
}

struct ArmPart {
  std::string_view implementer, part, name;
};

// ARM processors report only numbers. These are from Linux (MIDR_EL1), arch/arm64/include/asm/cputype.h.
constexpr std::array k_arm_parts{
    ArmPart{"0x41", "0xd03", "Arm Cortex-A53"},     ArmPart{"0x41", "0xd04", "Arm Cortex-A35"},
    ArmPart{"0x41", "0xd05", "Arm Cortex-A55"},     ArmPart{"0x41", "0xd07", "Arm Cortex-A57"},
    ArmPart{"0x41", "0xd08", "Arm Cortex-A72"},     ArmPart{"0x41", "0xd09", "Arm Cortex-A73"},
    ArmPart{"0x41", "0xd0a", "Arm Cortex-A75"},     ArmPart{"0x41", "0xd0b", "Arm Cortex-A76"},
    ArmPart{"0x41", "0xd0c", "Arm Neoverse-N1"},    ArmPart{"0x41", "0xd0d", "Arm Cortex-A77"},
    ArmPart{"0x41", "0xd40", "Arm Neoverse-V1"},    ArmPart{"0x41", "0xd41", "Arm Cortex-A78"},
    ArmPart{"0x41", "0xd44", "Arm Cortex-X1"},      ArmPart{"0x41", "0xd46", "Arm Cortex-A510"},
    ArmPart{"0x41", "0xd47", "Arm Cortex-A710"},    ArmPart{"0x41", "0xd48", "Arm Cortex-X2"},
    ArmPart{"0x41", "0xd49", "Arm Neoverse-N2"},    ArmPart{"0x41", "0xd4d", "Arm Cortex-A715"},
    ArmPart{"0x41", "0xd4e", "Arm Cortex-X3"},      ArmPart{"0x41", "0xd4f", "Arm Neoverse-V2"},
    ArmPart{"0x41", "0xd80", "Arm Cortex-A520"},    ArmPart{"0x41", "0xd81", "Arm Cortex-A720"},
    ArmPart{"0x41", "0xd82", "Arm Cortex-X4"},      ArmPart{"0x41", "0xd84", "Arm Neoverse-V3"},
    ArmPart{"0x41", "0xd85", "Arm Cortex-X925"},    ArmPart{"0x41", "0xd8e", "Arm Neoverse-N3"},
    ArmPart{"0x43", "0x0af", "Cavium ThunderX2"},   ArmPart{"0x46", "0x001", "Fujitsu A64FX"},
    ArmPart{"0x48", "0xd01", "HiSilicon TSV110"},   ArmPart{"0x61", "0x022", "Apple M1 Icestorm"},
    ArmPart{"0x61", "0x023", "Apple M1 Firestorm"}, ArmPart{"0x61", "0x032", "Apple M2 Blizzard"},
    ArmPart{"0x61", "0x033", "Apple M2 Avalanche"}, ArmPart{"0x6d", "0xd49", "Microsoft Azure Cobalt 100"},
    ArmPart{"0xc0", "0xac3", "Ampere-1"},           ArmPart{"0xc0", "0xac4", "Ampere-1A"},
};

std::string arm_name(const std::string& implementer, const std::string& part) {
  const auto* found = std::find_if(k_arm_parts.begin(), k_arm_parts.end(), [&](const ArmPart& arm_part) {
    return arm_part.implementer == implementer && arm_part.part == part;
  });
  return found != k_arm_parts.end() ? std::string(found->name) : "ARM implementer " + implementer + " part " + part;
}

// "0x3" and "1": "r3p1".
std::string arm_revision(const std::string& variant, const std::string& revision) {
  return "r" + (variant.compare(0, 2, "0x") == 0 ? variant.substr(2) : variant) + "p" + revision;
}

std::string first_line(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return line;
}

// "48K", "32768K", "1M"; 0 for other text.
std::uint64_t bytes_of(const std::string& size) {
  std::uint64_t value = 0;
  for (const char c : size) {
    if (std::isdigit(static_cast<unsigned char>(c)) != 0)
      value = 10 * value + static_cast<std::uint64_t>(c - '0');
    else
      return c == 'K' ? value << 10 : c == 'M' ? value << 20 : 0;
  }
  return value;
}

}  // namespace

Processor processor_of(std::istream& cpuinfo) {
  std::map<std::string, std::string> fields = first_processor(cpuinfo);
  if (fields.contains("CPU part"))
    return {arm_name(fields["CPU implementer"], fields["CPU part"]), fields["CPU implementer"], fields["CPU part"],
            arm_revision(fields["CPU variant"], fields["CPU revision"])};
  const std::string name = fields["model name"];
  return {name.empty() ? "unknown" : name, fields["cpu family"], fields["model"], fields["stepping"]};
}

std::vector<std::pair<std::string, std::uint64_t>> caches_of(const std::filesystem::path& folder) {
  std::vector<std::pair<std::string, std::uint64_t>> caches;
  std::error_code none;
  for (int index = 0; std::filesystem::exists(folder / ("index" + std::to_string(index)), none); ++index) {
    const std::filesystem::path cache = folder / ("index" + std::to_string(index));
    const std::string type = first_line(cache / "type");
    const std::uint64_t bytes = bytes_of(first_line(cache / "size"));
    if (bytes > 0)
      caches.emplace_back("l" + first_line(cache / "level") +
                              (type == "Data"          ? "d"
                               : type == "Instruction" ? "i"
                                                       : ""),
                          bytes);
  }
  std::sort(caches.begin(), caches.end());
  return caches;
}

std::optional<Clock> clock_of(std::istream& cpuinfo, const std::filesystem::path& folder) {
  double sum_mhz = 0.0, count = 0.0;
  for (std::string line; std::getline(cpuinfo, line);)
    if (const std::size_t colon = line.find(':'); line.starts_with("cpu MHz") && colon != std::string::npos) {
      sum_mhz += std::atof(line.c_str() + colon + 1);
      ++count;
    }
  const double first_khz = std::atof(first_line(folder / "scaling_cur_freq").c_str()),
               most_khz = std::atof(first_line(folder / "cpuinfo_max_freq").c_str());
  Clock clock{sum_mhz > 0.0 ? sum_mhz / count : first_khz / 1e3, {}};
  if (most_khz > 0.0) clock.most_mhz = most_khz / 1e3;
  return clock.now_mhz > 0.0 ? std::optional(clock) : std::nullopt;
}

ProcessorTime processor_time(std::istream& stat) {
  constexpr double k_ticks_per_s = 100.0;  // USER_HZ, which is part of the kernel's interface
  std::string name;
  double user = 0, nice = 0, system = 0, idle = 0, waiting = 0, irq = 0, soft_irq = 0, stolen = 0;
  stat >> name >> user >> nice >> system >> idle >> waiting >> irq >> soft_irq >> stolen;
  if (!stat || name != "cpu") return {};
  return {(user + nice + system + irq + soft_irq) / k_ticks_per_s, stolen / k_ticks_per_s};
}

std::optional<double> load_of(std::istream& loadavg) {
  double minute = 0.0;
  return loadavg >> minute ? std::optional(minute) : std::nullopt;
}

}  // namespace clusterbench::os

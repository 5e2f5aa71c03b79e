#include "gpu/device/device_choice.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "core/error.h"

namespace clusterbench::gpu {
namespace {

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

// Longer numbers are parts of names ("630").
bool is_index(const std::string& text) {
  return !text.empty() && text.size() <= 2 &&
         std::ranges::all_of(text, [](unsigned char c) { return std::isdigit(c); });
}

// The larger the better.
int rank(const DeviceFacts& device) {
  static constexpr std::array k_ranks{DeviceType::other, DeviceType::software, DeviceType::virtual_gpu,
                                      DeviceType::integrated, DeviceType::discrete};
  return static_cast<int>(std::ranges::find(k_ranks, device.type) - k_ranks.begin());
}

std::string names_of(const DeviceList& list) {
  std::string text;
  for (std::size_t i = 0; i < list.devices.size(); ++i)
    text += (i == 0 ? "" : ", ") + std::to_string(i) + " (" + list.devices[i].name + ")";
  return text;
}

bool is_called(const DeviceFacts& device, const std::string& wanted) {
  return device.uuid == wanted || lower(device.name) == wanted;
}

bool is_named(const DeviceFacts& device, const std::string& wanted) {
  return (wanted.size() >= 8 && device.uuid.starts_with(wanted)) ||
         lower(device.name).find(wanted) != std::string::npos;
}

std::vector<std::size_t> devices_where(const DeviceList& list, bool (*is_meant)(const DeviceFacts&, const std::string&),
                                       const std::string& wanted) {
  std::vector<std::size_t> meant;
  for (std::size_t i = 0; i < list.devices.size(); ++i)
    if (is_meant(list.devices[i], wanted)) meant.push_back(i);
  return meant;
}

std::size_t named_device(const DeviceList& list, const std::string& wanted) {
  std::vector<std::size_t> named;
  if (is_index(wanted)) {
    if (std::stoul(wanted) < list.devices.size()) named = {std::stoul(wanted)};
  } else {
    named = devices_where(list, is_called, lower(wanted));  // a whole name can be a part of another one
    if (named.empty()) named = devices_where(list, is_named, lower(wanted));
  }
  if (named.size() == 1) return named.front();
  const std::string fault = named.empty() ? "is no device of this machine" : "is the name of several devices";
  throw Error("", "device",
              "'" + wanted + "' " + fault + "; devices here: " + names_of(list) +
                  "; an index, a UUID or a part of one name is allowed");
}

}  // namespace

std::size_t chosen_device(const DeviceList& list, const std::string& wanted) {
  if (list.devices.empty()) throw Error("", "device", list.obstacle);
  if (!wanted.empty()) {
    const std::size_t index = named_device(list, wanted);
    if (const DeviceFacts& device = list.devices[index]; !device.obstacle.empty())
      throw Error("", "device", device.name + " " + device.obstacle);
    return index;
  }
  std::size_t best = list.devices.size();
  for (std::size_t i = 0; i < list.devices.size(); ++i)
    if (list.devices[i].obstacle.empty() &&
        (best == list.devices.size() || rank(list.devices[i]) > rank(list.devices[best])))
      best = i;
  if (best == list.devices.size())
    throw Error("", "device", list.devices.front().name + " " + list.devices.front().obstacle);
  return best;
}

std::string lacking(const DeviceFacts& device, const Needs& needs) {
  if (needs.ballots && !device.has_ballots) return "has no ballots in subgroups";
  if (needs.subgroup_arithmetic && !device.has_subgroup_arithmetic) return "has no arithmetic over subgroups";
  if (needs.full_subgroups && !device.has_full_subgroups)
    return "cannot be asked for subgroups without idle invocations";
  return "";
}

std::size_t same_device(const DeviceList& list, const DeviceFacts& before) {
  for (std::size_t i = 0; i < list.devices.size(); ++i) {
    const DeviceFacts& now = list.devices[i];
    if (now.uuid != before.uuid || now.name != before.name || now.driver != before.driver) continue;
    if (!now.obstacle.empty()) throw Error("", "device", now.name + " " + now.obstacle);
    return i;
  }
  const std::string rest = list.devices.empty() ? list.obstacle : "devices here: " + names_of(list);
  throw Error("", "device",
              before.name + " (UUID " + before.uuid + "), which this run began with, is gone; " + rest +
                  ", and results of two devices do not go together");
}

}  // namespace clusterbench::gpu

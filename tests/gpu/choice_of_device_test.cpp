// Which device words choose, on lists that are made up.

#include <gtest/gtest.h>

#include <algorithm>

#include "core/error.h"
#include "gpu/device/device_choice.h"

namespace clusterbench::gpu {
namespace {

DeviceFacts made_up(const std::string& name, DeviceType type, const std::string& uuid,
                    const std::string& obstacle = "") {
  DeviceFacts facts;
  facts.name = name;
  facts.type = type;
  facts.uuid = uuid;
  facts.obstacle = obstacle;
  return facts;
}

DeviceList a_workstation() {
  return {{made_up("llvmpipe (LLVM 15.0.6, 256 bits)", DeviceType::software, "6c6c766d706970650000000000000000"),
           made_up("Intel(R) UHD Graphics 630", DeviceType::integrated, "8680923e0000000002000000000000aa"),
           made_up("NVIDIA GeForce RTX 4090", DeviceType::discrete, "10de26840000000001000000000000bb"),
           made_up("NVIDIA GeForce RTX 4090", DeviceType::discrete, "10de26840000000002000000000000cc"),
           made_up("NVIDIA GeForce GTX 460", DeviceType::discrete, "10de0e220000000003000000000000dd",
                   "has Vulkan 1.0.3; 1.2 is needed")},
          ""};
}

std::string refusal(const DeviceList& list, const std::string& wanted) {
  try {
    chosen_device(list, wanted);
  } catch (const Error& error) {
    EXPECT_EQ(error.where(), "device");
    return error.message();
  }
  return "chosen";
}

TEST(ChoiceOfDevice, takes_an_index) {
  for (const std::size_t index : {0u, 1u, 2u, 3u})
    EXPECT_EQ(chosen_device(a_workstation(), std::to_string(index)), index);
  EXPECT_EQ(chosen_device(a_workstation(), "02"), 2u);
}

TEST(ChoiceOfDevice, takes_a_uuid_or_its_start_in_any_case) {
  EXPECT_EQ(chosen_device(a_workstation(), "10de26840000000002000000000000cc"), 3u);
  EXPECT_EQ(chosen_device(a_workstation(), "10DE26840000000002000000000000CC"), 3u);
  EXPECT_EQ(chosen_device(a_workstation(), "8680923e"), 1u);
  EXPECT_EQ(chosen_device(a_workstation(), "10de268400000000020"), 3u);
}

TEST(ChoiceOfDevice, takes_no_uuid_by_fewer_than_eight_digits) {
  EXPECT_NE(refusal(a_workstation(), "8680923").find("is no device of this machine"), std::string::npos);
}

TEST(ChoiceOfDevice, takes_a_part_of_a_name_in_any_case) {
  EXPECT_EQ(chosen_device(a_workstation(), "UHD"), 1u);
  EXPECT_EQ(chosen_device(a_workstation(), "llvm"), 0u);
  EXPECT_EQ(chosen_device(a_workstation(), "intel(r) uhd graphics 630"), 1u);
}

// A number above all indices can be a part of a name.
TEST(ChoiceOfDevice, takes_a_number_that_is_no_index_for_a_part_of_a_name) {
  EXPECT_EQ(chosen_device(a_workstation(), "630"), 1u);
}

TEST(ChoiceOfDevice, takes_a_whole_name_where_it_is_a_part_of_another_one) {
  DeviceList list = a_workstation();
  list.devices[3].name = "NVIDIA GeForce RTX 4090 D";
  EXPECT_EQ(chosen_device(list, "nvidia geforce rtx 4090"), 2u);
  EXPECT_EQ(chosen_device(list, "4090 d"), 3u);
}

TEST(ChoiceOfDevice, refuses_what_names_several_and_lists_all) {
  EXPECT_EQ(refusal(a_workstation(), "rtx"),
            "'rtx' is the name of several devices; devices here: 0 (llvmpipe (LLVM 15.0.6, 256 bits)), 1 (Intel(R) UHD "
            "Graphics 630), 2 (NVIDIA GeForce RTX 4090), 3 (NVIDIA GeForce RTX 4090), 4 (NVIDIA GeForce GTX 460); an "
            "index, a UUID or a part of one name is allowed");
  EXPECT_NE(refusal(a_workstation(), "10de2684").find("is the name of several devices"), std::string::npos);
}

TEST(ChoiceOfDevice, refuses_what_names_none_and_lists_all) {
  for (const char* wanted : {"radeon", "5", "99999999999999999999", "-1", "ffffffffffffffffffffffffffffffff"}) {
    const std::string begin = "'" + std::string(wanted) + "' is no device of this machine; devices here: 0 (llvmpipe";
    EXPECT_TRUE(refusal(a_workstation(), wanted).starts_with(begin)) << refusal(a_workstation(), wanted);
  }
}

TEST(ChoiceOfDevice, refuses_a_device_that_cannot_be_used_with_its_reason) {
  for (const char* wanted : {"4", "gtx 460", "10de0e22"})
    EXPECT_EQ(refusal(a_workstation(), wanted), "NVIDIA GeForce GTX 460 has Vulkan 1.0.3; 1.2 is needed");
}

TEST(ChoiceOfDevice, without_words_is_discrete_before_integrated_before_virtual_before_software_before_others) {
  DeviceList list = a_workstation();
  list.devices.insert(list.devices.begin(),
                      {made_up("a", DeviceType::other, "00"), made_up("b", DeviceType::software, "01"),
                       made_up("c", DeviceType::virtual_gpu, "02")});
  const auto chosen = [&] { return list.devices[chosen_device(list, "")].name; };
  const auto take_away = [&](DeviceType type) {
    std::erase_if(list.devices, [&](const DeviceFacts& device) { return device.type == type; });
  };
  EXPECT_EQ(list.devices[chosen_device(list, "")].uuid, "10de26840000000001000000000000bb");  // the first of two
  take_away(DeviceType::discrete);
  EXPECT_EQ(chosen(), "Intel(R) UHD Graphics 630");
  take_away(DeviceType::integrated);
  EXPECT_EQ(chosen(), "c");
  take_away(DeviceType::virtual_gpu);
  EXPECT_EQ(chosen(), "b");
  take_away(DeviceType::software);
  EXPECT_EQ(chosen(), "a");
}

TEST(ChoiceOfDevice, without_words_is_a_device_that_can_be_used) {
  DeviceList list = a_workstation();
  for (const std::size_t discrete : {2u, 3u}) list.devices[discrete].obstacle = "has no queue that computes";
  EXPECT_EQ(chosen_device(list, ""), 1u);
  list.devices[1].obstacle = list.devices[0].obstacle = "lets a shader see 8 buffers; 12 are needed";
  EXPECT_EQ(refusal(list, ""), "llvmpipe (LLVM 15.0.6, 256 bits) lets a shader see 8 buffers; 12 are needed");
}

TEST(ChoiceOfDevice, after_a_failure_is_the_same_device_wherever_it_stands_now) {
  const DeviceList before = a_workstation();
  DeviceList now = before;
  std::ranges::reverse(now.devices);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(same_device(now, before.devices[i]), 4 - i);
}

TEST(ChoiceOfDevice, after_a_failure_is_no_other_one_and_says_that_it_is_gone) {
  const DeviceFacts card = a_workstation().devices[2];
  const auto refusal_of = [&](const DeviceList& now) -> std::string {
    try {
      same_device(now, card);
    } catch (const Error& error) {
      return error.where() + ": " + error.message();
    }
    return "chosen";
  };
  DeviceList gone = a_workstation(), driver = gone, renamed = gone, useless = gone;
  gone.devices.erase(gone.devices.begin() + 2);
  driver.devices[2].driver = "another one";
  renamed.devices[2].name = "NVIDIA GeForce RTX 4090 D";
  useless.devices[2].obstacle = "has no queue that computes";
  for (const DeviceList& now : {gone, driver, renamed}) {
    const std::string told = refusal_of(now);
    EXPECT_TRUE(
        told.starts_with("device: NVIDIA GeForce RTX 4090 (UUID 10de26840000000001000000000000bb), which this "
                         "run began with, is gone; devices here: 0 (llvmpipe"))
        << told;
    EXPECT_TRUE(told.ends_with("), and results of two devices do not go together")) << told;
  }
  EXPECT_EQ(refusal_of(useless), "device: NVIDIA GeForce RTX 4090 has no queue that computes");
  EXPECT_EQ(
      refusal_of({{}, "no driver"}),
      "device: NVIDIA GeForce RTX 4090 (UUID 10de26840000000001000000000000bb), which this run began with, is gone; "
      "no driver, and results of two devices do not go together");
}

TEST(NeedsOfShaders, are_what_a_device_may_lack_each_in_a_sentence) {
  DeviceFacts plain, full;
  full.has_ballots = full.has_subgroup_arithmetic = full.has_full_subgroups = true;
  const Needs all{.ballots = true, .subgroup_arithmetic = true, .full_subgroups = true};
  EXPECT_EQ(lacking(plain, {}), "");
  EXPECT_EQ(lacking(full, all), "");
  EXPECT_EQ(lacking(plain, {.ballots = true}), "has no ballots in subgroups");
  EXPECT_EQ(lacking(plain, {.subgroup_arithmetic = true}), "has no arithmetic over subgroups");
  EXPECT_EQ(lacking(plain, {.full_subgroups = true}), "cannot be asked for subgroups without idle invocations");
  EXPECT_EQ(lacking(plain, all), "has no ballots in subgroups");
}

TEST(ChoiceOfDevice, without_devices_says_why_there_are_none) {
  for (const char* wanted : {"", "0", "nvidia"})
    EXPECT_EQ(refusal({{}, "no Vulkan loader on this machine (Debian: libvulkan1)"}, wanted),
              "no Vulkan loader on this machine (Debian: libvulkan1)");
}

}  // namespace
}  // namespace clusterbench::gpu

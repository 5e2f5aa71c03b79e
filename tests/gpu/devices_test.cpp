// What the drivers of this machine tell about their devices.

#include <algorithm>
#include <cctype>
#include <cstdlib>

#include "core/error.h"
#include "gpu/device/device_choice.h"
#include "gpu/device_test.h"

namespace clusterbench::gpu {
namespace {

class Devices : public testing::DeviceTest {};

TEST_F(Devices, have_facts_that_Vulkan_allows) {
  const DeviceList list = list_devices();
  EXPECT_EQ(list.obstacle, "");
  ASSERT_FALSE(list.devices.empty());
  for (const DeviceFacts& device : list.devices) {
    EXPECT_FALSE(device.name.empty());
    EXPECT_TRUE(device.vulkan.starts_with("1.")) << device.vulkan;
    if (!device.obstacle.empty()) continue;
    EXPECT_GT(device.driver.size(), 1u);
    EXPECT_EQ(device.uuid.size(), 32u);
    EXPECT_TRUE(std::ranges::all_of(device.uuid, [](unsigned char c) { return std::isxdigit(c) && !std::isupper(c); }));
    EXPECT_GE(device.max_buffer_bytes, 1u << 27);
    EXPECT_GE(device.max_group_size, 128u);
    EXPECT_GE(device.shared_bytes, 16384u);
    EXPECT_TRUE(device.subgroup_size >= 1 && device.subgroup_size <= 128) << device.subgroup_size;
    EXPECT_EQ(device.subgroup_size & (device.subgroup_size - 1), 0u) << device.subgroup_size;
    EXPECT_TRUE(device.timestamp_bits == 0 || (device.timestamp_bits >= 36 && device.timestamp_bits <= 64));
    EXPECT_TRUE(device.timestamp_bits == 0 || device.timestamp_period_ns > 0.0);
  }
}

// CTest runs this on software drivers alone (tests/CMakeLists.txt).
TEST_F(Devices, of_lavapipe_and_swiftshader_are_software) {
  const DeviceFacts& facts = device().facts();
  const bool is_known = facts.name.starts_with("llvmpipe") || facts.name.starts_with("SwiftShader");
  if (!is_known) GTEST_SKIP() << "skipped: " << facts.name << " is a GPU";
  EXPECT_TRUE(facts.is_software());
  EXPECT_EQ(type_name(facts.type), "software");
  EXPECT_EQ(facts.obstacle, "");
}

TEST_F(Devices, are_the_same_at_each_look_and_when_opened) {
  const DeviceList first = list_devices(), second = list_devices();
  ASSERT_EQ(first.devices.size(), second.devices.size());
  for (std::size_t i = 0; i < first.devices.size(); ++i) {
    EXPECT_EQ(first.devices[i].uuid, second.devices[i].uuid);
    EXPECT_EQ(chosen_device(first, std::to_string(i)), i);
  }
  EXPECT_EQ(device().facts().uuid, first.devices[chosen_device(first, "")].uuid);
}

TEST_F(Devices, are_opened_by_their_uuid_and_a_wrong_name_says_which_there_are) {
  const std::string name = device().facts().name, uuid = device().facts().uuid;
  use_device(uuid);
  EXPECT_EQ(device().facts().name, name);
  use_device("no such device");
  EXPECT_NE(device_obstacle().find("'no such device' is no device of this machine; devices here: 0 (" + name),
            std::string::npos)
      << device_obstacle();
  EXPECT_THROW(device(), Error);
  use_device("");
  EXPECT_EQ(device_obstacle(), "");
  EXPECT_EQ(device().facts().name, name);
}

TEST_F(Devices, open_after_a_failure_as_the_one_that_was_open_before_and_as_no_other) {
  const DeviceFacts first = device().facts();
  close_device();
  EXPECT_EQ(device().facts().uuid, first.uuid);
  EXPECT_EQ(Device("words that then mean nothing", &first).facts().uuid, first.uuid);
  DeviceFacts other = first;
  other.uuid = std::string(32, '0');
  try {
    const Device opened("", &other);
    ADD_FAILURE() << "opened " << opened.facts().name;
  } catch (const Error& error) {
    EXPECT_TRUE(error.message().starts_with(first.name +
                                            " (UUID 00000000000000000000000000000000), which this run began "
                                            "with, is gone; devices here: 0 ("))
        << error.message();
  }
}

// --- Without a driver: CTest sets VK_DRIVER_FILES to a file that does not exist ---

class NoDriver : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* driver = std::getenv("VK_DRIVER_FILES");
    if (driver == nullptr || std::string(driver).find("no-such-driver") == std::string::npos)
      GTEST_SKIP() << "skipped: VK_DRIVER_FILES names a driver";
  }
};

bool is_one_sentence(const std::string& text) {
  return text.size() > 20 && text.size() < 200 && text.find('\n') == std::string::npos && text.back() != '.';
}

TEST_F(NoDriver, is_one_sentence_that_a_list_of_devices_a_device_and_each_method_give) {
  const std::string reason = list_devices().obstacle;
  EXPECT_TRUE(list_devices().devices.empty());
  EXPECT_TRUE(is_one_sentence(reason)) << reason;
  EXPECT_TRUE(reason.find("driver") != std::string::npos || reason.find("built without") != std::string::npos)
      << reason;
  EXPECT_EQ(device_obstacle(), reason);
  register_methods();
  int methods = 0;
  for (const assign::AssignerDescriptor* row : assign::assigner_descriptors()) {
    if (!row->on_device) continue;
    EXPECT_EQ(assign::unavailability(*row, assign::Params(row->params)), reason) << row->name;
    ++methods;
  }
  EXPECT_GE(methods, 4);
}

TEST_F(NoDriver, is_an_error_where_a_device_is_asked_for) {
  for (const char* wanted : {"", "0", "llvmpipe"}) try {
      const Device opened(wanted);
      ADD_FAILURE() << "opened";
    } catch (const Error& error) {
      EXPECT_EQ(error.where(), "device");
      EXPECT_EQ(error.message(), list_devices().obstacle);
    }
}

}  // namespace
}  // namespace clusterbench::gpu

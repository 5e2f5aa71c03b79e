// Buffers and commands: what goes to a device comes back, limits are named, threads take turns.

#include <numeric>
#include <thread>

#include "assign/settings.h"
#include "core/error.h"
#include "core/memory.h"
#include "gpu/device_test.h"
#include "gpu/methods/frame_arguments.h"

namespace clusterbench::gpu {
namespace {

class DeviceCommands : public testing::DeviceTest {};

using Words = std::vector<std::uint32_t>;

Words numbers_from(std::uint32_t first, std::size_t count) {
  Words words(count);
  std::iota(words.begin(), words.end(), first);
  return words;
}

std::uint64_t bytes_of_words(const Words& words) {
  return words.size() * sizeof(std::uint32_t);
}

Words words_of(std::span<const std::uint32_t> downloaded) {
  return {downloaded.begin(), downloaded.end()};
}

std::string message_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.where() + ": " + error.message();
  }
  return "nothing";
}

// Sizes around that of the first staging buffer, which is outgrown in the middle of a recording.
TEST_F(DeviceCommands, bring_back_what_was_uploaded_however_long_it_is) {
  Buffers buffers(device());
  for (const std::size_t count : {1u, 2u, 1000u, 16384u, 16385u, 100000u, 3u}) {
    const Words a = numbers_from(7, count), b = numbers_from(1u << 20, 2 * count), c = numbers_from(3, 5);
    buffers.reserve(Binding::counts, bytes_of_words(a), "a");
    buffers.reserve(Binding::lists, bytes_of_words(b), "b");
    buffers.reserve(Binding::sums, bytes_of_words(c), "c");
    Commands commands(device(), buffers);
    commands.upload(Binding::counts, a.data(), bytes_of_words(a));
    commands.upload(Binding::sums, c.data(), bytes_of_words(c));
    commands.upload(Binding::lists, b.data(), bytes_of_words(b));
    commands.download(Binding::lists, bytes_of_words(b));
    commands.download(Binding::counts, bytes_of_words(a));
    commands.download(Binding::sums, 0);
    commands.download(Binding::sums, bytes_of_words(c));
    commands.run();
    EXPECT_EQ(words_of(commands.downloaded(0)), b) << count;
    EXPECT_EQ(words_of(commands.downloaded(1)), a) << count;
    EXPECT_TRUE(commands.downloaded(2).empty());
    EXPECT_EQ(words_of(commands.downloaded(3)), c) << count;
  }
}

TEST_F(DeviceCommands, fill_a_buffer_and_no_more_of_it_than_asked_for) {
  Buffers buffers(device());
  const Words before = numbers_from(0, 100);
  buffers.reserve(Binding::masks, bytes_of_words(before), "masks");
  Commands commands(device(), buffers);
  commands.upload(Binding::masks, before.data(), bytes_of_words(before));
  commands.barrier();
  commands.fill(Binding::masks, 0xabcdu, 40 * sizeof(std::uint32_t));
  commands.download(Binding::masks, bytes_of_words(before));
  commands.run();
  Words expected = before;
  std::fill_n(expected.begin(), 40, 0xabcdu);
  EXPECT_EQ(words_of(commands.downloaded(0)), expected);
}

// A buffer that was refused or did not fit can be asked for again.
TEST_F(DeviceCommands, count_the_steps_that_wait_for_each_other) {
  Buffers buffers(device());
  buffers.reserve(0, 64, "words");
  Commands commands(device(), buffers);
  commands.barrier();
  EXPECT_EQ(commands.steps(), 0u);
  commands.fill(0, 1, 32);
  commands.fill(1, 1, 32);
  commands.fill(2, 1, 0);
  EXPECT_EQ(commands.steps(), 1u);
  commands.barrier();
  commands.barrier();
  commands.fill(0, 2, 32);
  EXPECT_EQ(commands.steps(), 2u);
  commands.run();
}

TEST_F(DeviceCommands, refuse_a_buffer_above_the_devices_limit_with_both_numbers) {
  Buffers buffers(device());
  const std::uint64_t limit = device().facts().max_buffer_bytes;
  const std::string reason = message_of([&] { buffers.reserve(Binding::lists, limit + 1, "lists"); });
  EXPECT_EQ(reason, "device: lists need a buffer of " + std::to_string(limit + 1) + " bytes; " + device().facts().name +
                        " allows " + std::to_string(limit) + "; use fewer lights or cells");
  {
    const MemoryLimitScope scope(1000);
    const std::string above = message_of([&] { buffers.reserve(Binding::lists, 2000, "lists"); });
    EXPECT_NE(above.find("limits.memory_mib: 2000 lists would take"), std::string::npos) << above;
  }
  const Words words = numbers_from(5, 500);
  buffers.reserve(Binding::lists, bytes_of_words(words), "lists");
  EXPECT_GE(buffers.bytes(Binding::lists), bytes_of_words(words));
  EXPECT_GE(buffers.all_bytes(), bytes_of_words(words));
  Commands commands(device(), buffers);
  commands.upload(Binding::lists, words.data(), bytes_of_words(words));
  commands.download(Binding::lists, bytes_of_words(words));
  commands.run();
  EXPECT_EQ(words_of(commands.downloaded(0)), words);
}

TEST_F(DeviceCommands, refuse_groups_above_the_devices_limit_and_shaders_that_do_not_exist) {
  const std::uint32_t most = device().facts().max_group_size;
  EXPECT_EQ(message_of([&] { device().kernel("cells", most + 1); }),
            "device: " + device().facts().name + " runs at most " + std::to_string(most) +
                " invocations in a group; cells needs " + std::to_string(most + 1));
  EXPECT_EQ(message_of([&] { device().kernel("no_such", 64); }), "device: there is no shader no_such");
  EXPECT_EQ(device().kernel("cells", 64), device().kernel("cells", 64));
  EXPECT_NE(device().kernel("cells", 64, Mode::count), device().kernel("cells", 64, Mode::fill));
}

TEST_F(DeviceCommands, tell_times_that_add_up) {
  Buffers buffers(device());
  Commands commands(device(), buffers);
  commands.mark();
  commands.fill(Binding::masks, 0, 256);
  commands.mark();
  commands.run();  // and a mark at its end
  if (device().facts().timestamp_bits == 0) {
    EXPECT_EQ(commands.ns_between(0, 2), 0.0);
  } else {
    EXPECT_GE(commands.ns_between(0, 1), 0.0);
    EXPECT_GT(commands.ns_between(0, 2), 0.0);
    EXPECT_NEAR(commands.ns_between(0, 1) + commands.ns_between(1, 2), commands.ns_between(0, 2), 1.0);
    EXPECT_LT(commands.ns_between(0, 2), 10e9);
  }
}

// Closing leaves nothing behind that the validation layer would object to, which the second recording would report.
TEST_F(DeviceCommands, run_on_a_device_that_is_closed_and_opened_again) {
  for (int i = 0; i < 2; ++i) {
    Device own("");
    own.kernel("cells", 64);
    Buffers buffers(own);
    const Words words = numbers_from(1, 10);
    Commands commands(own, buffers);
    commands.upload(Binding::counts, words.data(), bytes_of_words(words));
    commands.download(Binding::counts, bytes_of_words(words));
    commands.run();
    EXPECT_EQ(words_of(commands.downloaded(0)), words);
  }
}

// --- The sums of counts, which all lists rest on ---

struct Sums {
  Words list_begins;
  std::uint32_t end = 0;
};

Sums sums_of(const Words& counts) {
  const auto cells = static_cast<std::uint32_t>(counts.size());
  const std::uint32_t blocks = (cells + 255) / 256;
  Buffers buffers(device());
  for (const Binding binding : {Binding::counts, Binding::offsets, Binding::sums})
    buffers.reserve(binding, bytes_of_words(counts), "counts");
  buffers.reserve(Binding::begins, bytes_of_words(counts) + sizeof(std::uint32_t), "begins");
  const Kernel of_blocks = device().kernel("sum_blocks", 256), of_sums = device().kernel("sum_sums", 256);
  FrameArguments arguments;
  arguments.cells = cells;
  Commands commands(device(), buffers);
  commands.upload(Binding::counts, counts.data(), bytes_of_words(counts));
  commands.barrier();
  commands.dispatch(of_blocks, arguments, blocks);
  commands.barrier();
  commands.dispatch(of_sums, arguments, 1);
  commands.download(Binding::offsets, bytes_of_words(counts));
  commands.download(Binding::sums, blocks * sizeof(std::uint32_t));
  commands.download(Binding::begins, bytes_of_words(counts) + sizeof(std::uint32_t));
  commands.run();
  const auto offsets = commands.downloaded(0), sums = commands.downloaded(1), begins = commands.downloaded(2);
  Sums out{Words(cells), begins.back()};
  for (std::uint32_t cell = 0; cell < cells; ++cell) out.list_begins[cell] = sums[cell / 256] + offsets[cell];
  return out;
}

// One cell, the ends of a block, and more than 256 blocks: the second kernel takes several turns.
TEST_F(DeviceCommands, sum_the_counts_of_any_number_of_cells) {
  assign::testing::Random random(5);
  for (const std::uint32_t cells : {1u, 2u, 255u, 256u, 257u, 511u, 513u, 65535u, 65536u, 65537u, 140001u}) {
    Words counts(cells);
    for (std::uint32_t& count : counts) count = static_cast<std::uint32_t>(random.unit() * 90);
    Words expected(cells);
    std::exclusive_scan(counts.begin(), counts.end(), expected.begin(), 0u);
    const Sums found = sums_of(counts);
    EXPECT_TRUE(found.list_begins == expected) << cells;
    EXPECT_EQ(found.end, expected.back() + counts.back()) << cells;
  }
}

TEST_F(DeviceCommands, say_that_a_sum_is_beyond_32_bits) {
  Words counts(1000, 8'000'000);
  EXPECT_EQ(sums_of(counts).end, 0xffffffffu);
  counts.assign(70000, 1'000'000);  // in the second turn of the second kernel
  EXPECT_EQ(sums_of(counts).end, 0xffffffffu);
  counts.assign(1000, 4'000'000);
  EXPECT_EQ(sums_of(counts).end, 4'000'000'000u);
}

// --- Threads ---

TEST_F(DeviceCommands, of_several_threads_take_turns) {
  device();
  std::vector<std::thread> threads;
  std::array<int, 4> wrong{};
  for (std::uint32_t thread = 0; thread < wrong.size(); ++thread)
    threads.emplace_back([&wrong, thread] {
      Buffers buffers(device());
      buffers.reserve(Binding::lists, 40000, "lists");
      for (std::uint32_t i = 0; i < 40; ++i) {
        device().kernel(i % 2 == 0 ? "cells" : "group", 64, thread % 2);
        const Words words = numbers_from(thread << 20 | i << 10, 10000);
        Commands commands(device(), buffers);
        commands.upload(Binding::lists, words.data(), bytes_of_words(words));
        commands.download(Binding::lists, bytes_of_words(words));
        commands.run();
        wrong[thread] += words_of(commands.downloaded(0)) != words;
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, (std::array<int, 4>{}));
}

}  // namespace
}  // namespace clusterbench::gpu

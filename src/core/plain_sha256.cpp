#include "core/plain_sha256.h"

#include <algorithm>
#include <bit>

namespace clusterbench {
namespace {

constexpr std::size_t k_block = 64;

// FIPS 180-4, 4.2.2: the first 32 bits of the fractions of the cube roots of the first 64 primes.
constexpr std::array<std::uint32_t, 64> k_rounds = {
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

std::uint32_t big_endian_word(const unsigned char* bytes) {
  return std::uint32_t{bytes[0]} << 24 | std::uint32_t{bytes[1]} << 16 | std::uint32_t{bytes[2]} << 8 | bytes[3];
}

// The words of the 64 rounds (6.2.2, 1).
std::array<std::uint32_t, 64> schedule_of(const unsigned char* block) {
  std::array<std::uint32_t, 64> w;
  for (std::size_t i = 0; i < 16; ++i) w[i] = big_endian_word(block + 4 * i);
  for (std::size_t i = 16; i < 64; ++i) {
    const std::uint32_t a = w[i - 15], b = w[i - 2];
    const std::uint32_t small0 = std::rotr(a, 7) ^ std::rotr(a, 18) ^ (a >> 3);
    const std::uint32_t small1 = std::rotr(b, 17) ^ std::rotr(b, 19) ^ (b >> 10);
    w[i] = small1 + w[i - 7] + small0 + w[i - 16];
  }
  return w;
}

}  // namespace

// 6.2.2, 2 to 4.
void PlainSha256::add_block(const unsigned char* bytes) {
  const std::array<std::uint32_t, 64> w = schedule_of(bytes);
  auto [a, b, c, d, e, f, g, h] = state_;
  for (std::size_t i = 0; i < 64; ++i) {
    const std::uint32_t large1 = std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25);
    const std::uint32_t t1 = h + large1 + ((e & f) ^ (~e & g)) + k_rounds[i] + w[i];
    const std::uint32_t large0 = std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22);
    const std::uint32_t t2 = large0 + ((a & b) ^ (a & c) ^ (b & c));
    h = g, g = f, f = e, e = d + t1, d = c, c = b, b = a, a = t1 + t2;
  }
  const std::array<std::uint32_t, 8> now = {a, b, c, d, e, f, g, h};
  for (std::size_t i = 0; i < 8; ++i) state_[i] += now[i];
}

void PlainSha256::add(std::string_view bytes) {
  const std::size_t kept = bytes_ % k_block;
  bytes_ += bytes.size();
  const std::size_t first = std::min(bytes.size(), kept == 0 ? 0 : k_block - kept);
  std::copy_n(bytes.data(), first, block_.begin() + static_cast<std::ptrdiff_t>(kept));
  if (kept > 0 && kept + first < k_block) return;
  if (kept > 0) add_block(block_.data());
  bytes.remove_prefix(first);
  for (; bytes.size() >= k_block; bytes.remove_prefix(k_block))
    add_block(reinterpret_cast<const unsigned char*>(bytes.data()));
  std::ranges::copy(bytes, block_.begin());
}

PlainSha256::Digest PlainSha256::digest() {
  const std::uint64_t bits = bytes_ * 8;
  constexpr std::size_t k_length = 8;  // bytes of the length at the end (5.1.1)
  add("\x80");
  constexpr char k_zeros[k_block] = {};
  const std::size_t used = bytes_ % k_block;
  add({k_zeros, used <= k_block - k_length ? k_block - k_length - used : 2 * k_block - k_length - used});
  char length[k_length];
  for (std::size_t i = 0; i < k_length; ++i) length[i] = static_cast<char>(bits >> (8 * (k_length - 1 - i)));
  add({length, k_length});
  Digest out;
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = static_cast<unsigned char>(state_[i / 4] >> (8 * (3 - i % 4)));
  return out;
}

}  // namespace clusterbench

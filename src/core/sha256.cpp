#include "core/sha256.h"

#include <array>

#include "core/plain_sha256.h"
#include "core/text.h"

#if CLUSTERBENCH_HAS_OPENSSL
#include <openssl/evp.h>
#endif

namespace clusterbench {

#if CLUSTERBENCH_HAS_OPENSSL
struct Sha256::State {
  EVP_MD_CTX* context = EVP_MD_CTX_new();
  State() { EVP_DigestInit_ex(context, EVP_sha256(), nullptr); }
  ~State() { EVP_MD_CTX_free(context); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  void add(std::string_view bytes) { EVP_DigestUpdate(context, bytes.data(), bytes.size()); }
  PlainSha256::Digest digest() {
    PlainSha256::Digest out{};
    EVP_DigestFinal_ex(context, out.data(), nullptr);
    return out;
  }
};
#else
struct Sha256::State : PlainSha256 {};
#endif

Sha256::Sha256() : state_(std::make_unique<State>()) {}
Sha256::~Sha256() = default;
Sha256::Sha256(Sha256&&) noexcept = default;
Sha256& Sha256::operator=(Sha256&&) noexcept = default;

void Sha256::add(std::string_view bytes) {
  state_->add(bytes);
}

std::string Sha256::hex() {
  constexpr char k_digits[] = "0123456789abcdef";
  std::string text;
  for (const unsigned char byte : state_->digest()) {
    text += k_digits[byte >> 4];
    text += k_digits[byte & 15];
  }
  return text;
}

std::string sha256_hex(std::string_view bytes) {
  Sha256 sum;
  sum.add(bytes);
  return sum.hex();
}

}  // namespace clusterbench

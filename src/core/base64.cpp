// Apart from the rest of core/text.h, which needs no library.

#include <openssl/evp.h>

#include <algorithm>

#include "core/text.h"

namespace clusterbench {

std::optional<std::string> base64_decoded(std::string_view text) {
  while (text.ends_with('=')) text.remove_suffix(1);
  if (text.size() % 4 == 1 || text.find('=') != std::string_view::npos) return std::nullopt;
  std::string padded(text);
  padded.resize((text.size() + 3) / 4 * 4, '=');
  std::string bytes(padded.size() / 4 * 3, '\0');
  constexpr std::size_t k_longest = std::size_t{1} << 30;  // characters of a call, which counts in int
  for (std::size_t from = 0; from < padded.size(); from += k_longest) {
    const std::size_t count = std::min(k_longest, padded.size() - from);
    const int decoded =
        EVP_DecodeBlock(reinterpret_cast<unsigned char*>(bytes.data() + from / 4 * 3),
                        reinterpret_cast<const unsigned char*>(padded.data() + from), static_cast<int>(count));
    // The decoder skips white space at either end, which gives fewer bytes.
    if (decoded < 0 || static_cast<std::size_t>(decoded) != count / 4 * 3) return std::nullopt;
  }
  bytes.resize(text.size() * 3 / 4);
  return bytes;
}

}  // namespace clusterbench

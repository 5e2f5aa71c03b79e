#pragma once
// `--shard I/N`: which part of a run this process measures.

#include <cstdint>
#include <functional>
#include <string>

namespace clusterbench::cli {

struct ShardChoice {
  std::uint64_t index = 1, count = 1;  // from 1 to count
};

// The value of an environment variable; nullptr if it is not set.
using Variable = std::function<const char*(const char* name)>;

// "2/7": the second of seven. "auto": what the environment says of an array job; "auto/7": the same, of seven, for
// environments that tell the index alone (Kubernetes). Throws Error that names the flag or the variable for anything
// else, for an index outside of 1 to N, for more than run::k_most_shards, for an environment that says nothing, and for
// two that contradict each other.
ShardChoice shard_choice(const std::string& text, const Variable& variable);
ShardChoice shard_choice(const std::string& text);

}  // namespace clusterbench::cli

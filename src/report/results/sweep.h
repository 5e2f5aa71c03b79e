#pragma once
// The shards of one run (`run --shard`): whether they are all there, and of one run.

#include <string>
#include <vector>

#include "result/result.h"

namespace clusterbench::report {

struct NamedPart {
  std::string file;
  result::Result result;
};

bool is_any_shard(const std::vector<NamedPart>& parts);

// Brings the shards of one run into their order; at least one part is a shard. Throws Error that names the files if a
// part is no shard, if parts are of different programs, configurations, scenes or numbers of shards, if a shard is
// there twice, or if one is missing.
void order_shards(std::vector<NamedPart>& parts);

}  // namespace clusterbench::report

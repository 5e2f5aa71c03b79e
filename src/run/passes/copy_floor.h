#pragma once
// The copy floor of a method: the time to copy its output (`write_floor_ns`, and `floor_ratio` against it).

#include <algorithm>
#include <cstring>
#include <vector>

#include "core/kept_stores.h"
#include "run/timing/timed_work.h"

namespace clusterbench::run {

// Memory traffic that no assignment method can avoid: the output of each frame, headers and indices, copied once. Each
// frame has its own buffers, one for headers and one for indices, like the lists: a single pair of buffers would stay
// in the cache while the lists of a long path do not.
class CopyFloor {
 public:
  // For lists: the output of the tight storage (`packed`); for a method's own structures: these as they are.
  explicit CopyFloor(const TimedWork& work) {
    const std::size_t frames = work.frame_count();
    for (std::size_t i = 0; i < std::min(frames, work.structures().size()); ++i) add_frame(work.structures()[i]->use());
    if (!work.converts()) return;
    const assign::StorageDescriptor& packed = *assign::find_storage("packed");
    for (std::size_t i = 0; i < frames; ++i) {
      const auto storage = work.storage(packed, assign::Params(packed.params), i);
      work.store_lists(*storage, i);
      add_frame(storage->use());
    }
  }

  void copy_once() {
    for (Copy& copy : copies_) {
      std::memcpy(copy.to.data(), copy.from.data(), copy.from.size());
      keep_stores(copy.to.data());
    }
  }

 private:
  struct Copy {
    std::vector<unsigned char> from, to;
  };

  void add_frame(const assign::StructureUse& use) {
    for (const std::uint64_t bytes : {use.header_bytes, use.index_bytes})
      if (bytes > 0) copies_.push_back({std::vector<unsigned char>(bytes, 1), std::vector<unsigned char>(bytes, 2)});
  }

  std::vector<Copy> copies_;
};

}  // namespace clusterbench::run

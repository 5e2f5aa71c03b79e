#pragma once
// Lists as the light structure that samples ask.

#include <memory>

#include "assign/contract/storage.h"

namespace clusterbench::measure {

// `grid` must outlive it.
inline std::unique_ptr<assign::Storage> packed_lists(const assign::Lists& lists, const grid::Grid& grid,
                                                     const view::Frame& frame) {
  const assign::StorageDescriptor& packed = *assign::find_storage("packed");
  auto structure = packed.make(assign::Params(packed.params));
  structure->start(grid, frame.ranges());
  structure->store(lists);
  return structure;
}

}  // namespace clusterbench::measure

#pragma once
// Light structures of this program as a dump describes them.

#include <optional>
#include <vector>

#include "assign/contract/lists.h"
#include "assign/contract/shader_buffers.h"
#include "layout/buffers.h"
#include "layout/cell_order.h"

namespace clusterbench::layout {

struct Described {
  std::vector<Buffer> buffers;  // without files
  result::DumpLists lists;
};

// nullopt for structures that dumps have no words for: sparse headers, masks of sorted lights, hierarchies.
std::optional<Described> describe(const assign::ShaderBuffers& shader);

// The lists as a program keeps them that numbers its cells in this order: list number order.cell(at) is that of cell
// at.
assign::Lists in_order(const assign::Lists& lists, Vec3i cells, const CellOrder& order);

}  // namespace clusterbench::layout

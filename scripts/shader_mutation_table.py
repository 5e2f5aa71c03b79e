"""The wrong changes of scripts/shader_mutations.py: slips of the kind that compute shaders have, file by file."""
from typing import NamedTuple


class Mutation(NamedTuple):
    name: str
    file: str  # below src/gpu/
    old: str  # occurs there once, or it is its place-th occurrence
    new: str
    place: int = 0  # counted from 1; 0: the only one
    unseen: str = ""  # why no test finds it; either it has no effect, or it is a gap


def barriers(shader, places):
    """Each barrier() of a shader left out, by what it is for."""
    return [Mutation(f"{shader}-barrier-{name}", f"shaders/{shader}.comp", "barrier();", ";", place)
            for place, name in enumerate(places, 1)]


MUTATIONS = [
    # --- common.glsl: what all methods decide by ---
    Mutation("touching-is-outside", "shaders/common.glsl", "squared <= reach;", "squared < reach;"),
    Mutation("empty-light-touches", "shaders/common.glsl", "ball.w >= 0.0 && squared", "squared"),
    Mutation("box-side-dropped", "shaders/common.glsl", "max(0.0, max(lo.y - ball.y, ball.y - hi.y))", "max(0.0, ball.y - hi.y)"),
    Mutation("depth-dropped", "shaders/common.glsl", "squared = x * x + y * y + z * z;\n  precise float reach", "squared = x * x + y * y;\n  precise float reach"),
    Mutation("columns-and-rows-swapped", "shaders/common.glsl", "uint row = index / frame.columns;", "uint row = index / frame.rows;"),
    Mutation("bounds-of-first-slice-for-all", "shaders/common.glsl", "bounds[at.z * frame.column_pitch + at.x]", "bounds[at.x]"),
    Mutation("second-row-of-groups-dropped", "shaders/common.glsl", "gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;", "gl_WorkGroupID.x;"),
    Mutation("list-begins-in-block", "shaders/common.glsl", "sums[cell / k_block] + offsets[cell]", "offsets[cell]"),
    Mutation("box-without-precise", "shaders/common.glsl", "precise float squared = x * x + y * y + z * z;\n  precise float reach", "float squared = x * x + y * y + z * z;\n  precise float reach"),
    Mutation("cone-without-precise", "shaders/common.glsl", "precise float left", "float left"),
    Mutation("cone-without-slack", "shaders/common.glsl", "ball.w + frame.cone_slack *", "ball.w + 0.0 *"),
    Mutation("cone-touching-is-outside", "shaders/common.glsl", "left <= right;", "left < right;"),
    Mutation("cone-cosine-and-sine-swapped", "shaders/common.glsl", "left = axis.w * axis.w * across, right", "left = sine * sine * across, right"),
    Mutation("cone-behind-too-strict", "shaders/common.glsl", "along < -reach ||", "along < 0.0 ||"),
    Mutation("cone-range-too-strict", "shaders/common.glsl", "squared > squared_farthest", "squared > apex.w * apex.w"),
    Mutation("cone-range-dropped", "shaders/common.glsl", "if (squared > squared_farthest) return false;", ""),
    Mutation("cone-behind-squared", "shaders/common.glsl", "beside >= 0.0 && left", "left",
             unseen="`along` is no less than -reach by then, and a sine no more than 1"),
    Mutation("cone-of-the-spot-before", "shaders/common.glsl", "cone_touches_ball(light - frame.points,", "cone_touches_ball(light - min(light, frame.points + 1),"),
    # --- cells.comp ---
    Mutation("cells-bounds-check", "shaders/cells.comp", "if (index >= frame.cells) return;", ""),
    Mutation("cells-capacity", "shaders/cells.comp", "if (count < room)", "if (MODE != k_fixed || count < room)"),
    Mutation("cells-capacity-off-by-one", "shaders/cells.comp", "if (count < room)", "if (count <= room)"),
    Mutation("cells-last-light", "shaders/cells.comp", "light < frame.lights; ++light) count", "light + 1 < frame.lights; ++light) count"),
    # --- group.comp ---
    *barriers("group", ["of-the-box", "before-bits", "before-places", "before-cells"]),
    Mutation("group-bounds-check", "shaders/group.comp", "if (block >= blocks.x * blocks.y * blocks.z) return;", "",
             unseen="no cell of such a block is in the grid, so that nothing is written; it saves their work"),
    Mutation("group-cells-beyond-grid-read", "shaders/group.comp", "cell_at(min(at, uvec3(frame.columns, frame.rows, frame.slices) - 1));", "cell_at(at);"),
    Mutation("group-cells-beyond-grid-written", "shaders/group.comp", "if (!is_cell) return;", ""),
    Mutation("group-lights-beyond-end", "shaders/group.comp", "if (batch + lane < frame.lights) ball", "if (batch + lane <= frame.lights) ball"),
    Mutation("group-capacity", "shaders/group.comp", "MODE == k_fill && begin + count < frame.capacity", "MODE == k_fill"),
    Mutation("group-capacity-off-by-one", "shaders/group.comp", "begin + count < frame.capacity", "begin + count <= frame.capacity"),
    Mutation("group-atomic", "shaders/group.comp", "atomicOr(kept_bits[lane / 32], 1u << (lane % 32))", "kept_bits[lane / 32] |= 1u << (lane % 32)"),
    Mutation("group-box-of-half", "shaders/group.comp", "half_size = 32;", "half_size = 16;"),
    Mutation("group-box-lower-only", "shaders/group.comp", "max(block_hi[lane], block_hi[lane + half_size])", "block_hi[lane]"),
    Mutation("group-last-block", "shaders/group.comp", "(frame.slices + 3) / 4);", "frame.slices / 4);"),
    Mutation("group-place-off-by-one", "shaders/group.comp", "(1u << (lane % 32)) - 1;", "(2u << (lane % 32)) - 1;"),
    Mutation("group-high-bits-before-low", "shaders/group.comp", "bitCount(low) + bitCount(high & before)", "bitCount(high & before)"),
    # --- lights.comp ---
    *barriers("lights", ["after-reset", "before-rectangle", "before-next-slice"]),
    Mutation("lights-bounds-check", "shaders/lights.comp", "if (light >= frame.lights) return;", ""),
    Mutation("lights-atomic-min", "shaders/lights.comp", "atomicMin(first_column, x);", "first_column = min(first_column, x);"),
    Mutation("lights-atomic-max", "shaders/lights.comp", "atomicMax(last_row, y);", "last_row = max(last_row, y);"),
    Mutation("lights-atomic-or", "shaders/lights.comp", "atomicOr(masks[cell.index * frame.words + light / 32], 1u << (light % 32));", "masks[cell.index * frame.words + light / 32] |= 1u << (light % 32);"),
    Mutation("lights-touching-slice-is-outside", "shaders/lights.comp", "if (squared > reach) continue;", "if (squared >= reach) continue;"),
    Mutation("lights-touching-column-is-outside", "shaders/lights.comp", "return sum <= reach;", "return sum < reach;"),
    Mutation("lights-last-column", "shaders/lights.comp", "last_column - first_column + 1,", "max(last_column - first_column, 1),"),
    Mutation("lights-last-row", "shaders/lights.comp", "(last_row - first_row + 1);", "max(last_row - first_row, 1);"),
    Mutation("lights-first-group-of-columns", "shaders/lights.comp", "x < frame.columns; x += gl_WorkGroupSize.x", "x < min(frame.columns, 64); x += gl_WorkGroupSize.x"),
    # --- mask.comp and mask_lists.comp ---
    *barriers("mask", ["after-reset", "before-words"]),
    Mutation("mask-bounds-check", "shaders/mask.comp", "if (index >= frame.cells) return;", ""),
    Mutation("mask-lights-beyond-end", "shaders/mask.comp", "light < frame.lights && touches", "touches"),
    Mutation("mask-atomic", "shaders/mask.comp", "atomicOr(bits[first / 32], ballot.x << (first % 32));", "bits[first / 32] |= ballot.x << (first % 32);"),
    Mutation("mask-ballot-not-moved", "shaders/mask.comp", "ballot.x << (first % 32)", "ballot.x"),
    Mutation("mask-words-beyond-end", "shaders/mask.comp", "if (slot < 2 && word + slot < frame.words)", "if (slot < 2)"),
    Mutation("mask-odd-word", "shaders/mask.comp", "(frame.words + 1) / 2;", "max(frame.words / 2, 1);"),
    Mutation("mask-lists-bounds-check", "shaders/mask_lists.comp", "if (index >= frame.cells) return;", ""),
    Mutation("mask-lists-capacity", "shaders/mask_lists.comp", "if (at < frame.capacity) lists", "lists"),
    Mutation("mask-lists-capacity-off-by-one", "shaders/mask_lists.comp", "at < frame.capacity", "at <= frame.capacity"),
    Mutation("mask-lists-word-of-31", "shaders/mask_lists.comp", "32 * word + findLSB(bits)", "31 * word + findLSB(bits)"),
    Mutation("mask-lists-last-word", "shaders/mask_lists.comp", "word < frame.words; ++word) count", "word + 1 < frame.words; ++word) count"),
    # --- sum_blocks.comp and sum_sums.comp ---
    *barriers("sum_blocks", ["before-read", "before-write"]),
    *barriers("sum_sums", ["before-read", "before-write", "before-carry"]),
    Mutation("sum-of-counts-beyond-end", "shaders/sum_blocks.comp", "cell < frame.cells ? counts[cell] : 0;", "counts[cell];"),
    Mutation("sum-offsets-beyond-end", "shaders/sum_blocks.comp", "if (cell < frame.cells) offsets", "offsets"),
    Mutation("sum-blocks-beyond-end", "shaders/sum_blocks.comp", "lane == k_block - 1 && cell - lane < frame.cells", "lane == k_block - 1",
             unseen="only grids of more than 8 million cells have groups beyond the last block"),
    Mutation("sum-with-own", "shaders/sum_blocks.comp", "partial[lane] - own;", "partial[lane];"),
    Mutation("sum-of-half-a-block", "shaders/sum_blocks.comp", "step_size < k_block;", "step_size < k_block / 2;"),
    Mutation("sum-first-left-out", "shaders/sum_blocks.comp", "lane >= step_size ?", "lane > step_size ?"),
    Mutation("sum-of-sums-beyond-end", "shaders/sum_sums.comp", "first + lane < blocks ? sums[first + lane] : 0;", "sums[first + lane];"),
    Mutation("sum-of-sums-written-beyond-end", "shaders/sum_sums.comp", "if (first + lane < blocks) sums", "sums"),
    Mutation("sum-without-carry", "shaders/sum_sums.comp", "carry = saturated_sum(start, partial[lane]);", "carry = partial[lane];"),
    Mutation("sum-wraps", "shaders/sum_sums.comp", "a > 0xffffffffu - b ? 0xffffffffu : a + b;", "a + b;"),
    Mutation("sum-last-block", "shaders/sum_sums.comp", "(frame.cells + k_block - 1) / k_block;", "max(frame.cells / k_block, 1);"),
    # --- tile_depths.comp and tile_lights.comp ---
    *barriers("tile_depths", ["after-reset", "before-range", "before-parts", "before-mask"]),
    *barriers("tile_lights", ["after-reset", "before-words"]),
    Mutation("tile-depths-atomic-min", "shaders/tile_depths.comp", "atomicMin(nearest, lo);", "nearest = min(nearest, lo);"),
    Mutation("tile-depths-atomic-or", "shaders/tile_depths.comp", "atomicOr(parts, bits);", "parts |= bits;"),
    Mutation("tile-depths-bounds-check", "shaders/tile_depths.comp", "if (tile >= frame.cells) return;", "",
             unseen="only pictures of more than 32,768 tiles have groups beyond the last tile"),
    Mutation("tile-lights-beyond-end", "shaders/tile_lights.comp", "light < frame.lights && meets_tile", "meets_tile"),
    Mutation("tile-lights-words-beyond-end", "shaders/tile_lights.comp", "if (lane < 2 && word + lane < frame.words)", "if (lane < 2)"),
    Mutation("tile-lights-touching-is-outside", "shaders/tile_lights.comp", "ball.x, -ball.z) > ball.w", "ball.x, -ball.z) >= ball.w",
             unseen="a ball is padded, so that one which just reaches the plane holds no light that does"),
    Mutation("tile-queue-position-not-atomic", "shaders/tile.glsl", "atomicAdd(queue.count, 1);", "queue.count++;"),
    Mutation("tile-queue-first-row-only", "shaders/tile.glsl", "place / k_groups_in_a_row + 1)", "1)"),
    Mutation("tile-queue-row-overflow", "shaders/tile.glsl", "min(place + 1, k_groups_in_a_row)", "place + 1"),
    Mutation("tile-queue-one-row-more", "shaders/tile.glsl", "place / k_groups_in_a_row + 1)", "(place + 1) / k_groups_in_a_row + 1)"),
    Mutation("tile-queue-no-depth-of-groups", "shaders/tile.glsl", "atomicMax(queue.groups_z, 1);", ""),
    Mutation("tile-queue-takes-the-sky", "shaders/tile_depths.comp", "    if (lane == 0) tiles[tile] = uvec4(k_infinity, k_sign | k_infinity, 0, 0);", "    if (lane == 0) { tiles[tile] = uvec4(k_infinity, k_sign | k_infinity, 0, 0); if ((MODE & k_appends) != 0) append_to_queue(tile); }"),
    Mutation("tile-queue-groups-beyond-end", "shaders/tile_lights.comp", "(MODE & k_occupied) != 0 ? queue.count : frame.cells", "frame.cells"),
    Mutation("tile-queue-not-read", "shaders/tile_lights.comp", "(MODE & k_occupied) != 0 ? queue.tiles[group] : group", "group"),
    Mutation("tile-queue-not-cleared", "methods/gpu_tiled.cpp", "  void record_beside_counts(Commands& commands) override { record_empty_queue(commands); }", "  void record_beside_counts(Commands&) override {}"),
    Mutation("tile-queue-not-cleared-at-first", "methods/gpu_tiled.cpp", "    record_empty_queue(commands);\n    commands.run();", "    commands.run();", 1),
    Mutation("tile-queue-not-cleared-without-lights", "methods/gpu_tiled.cpp", "    record_empty_queue(commands);\n    commands.run();", "    commands.run();", 2),
    Mutation("tile-queue-barrier-of-the-groups", "methods/gpu_tiled.cpp", "commands.barrier(Commands::Barrier::before_indirect);", "commands.barrier();"),
    Mutation("tile-queue-barrier-left-out", "methods/gpu_tiled.cpp", "      commands.barrier(Commands::Barrier::before_indirect);\n", ""),
    Mutation("commands-barrier-of-no-indirect-stage", "vulkan/commands.cpp", "k_work | VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT : k_work", "k_work : k_work"),
    # --- barriers between commands, padding and sizes on the host ---
    Mutation("commands-no-barriers", "vulkan/commands.cpp", "  vkCmdPipelineBarrier(device_.commands, k_work, next, 0, 1, &memory, 0, nullptr, 0, nullptr);\n}", "}"),
    Mutation("commands-barrier-of-nothing-written", "vulkan/commands.cpp", "nullptr, VK_ACCESS_MEMORY_WRITE_BIT,", "nullptr, 0,"),
    Mutation("commands-barrier-before-copies", "vulkan/commands.cpp", "    barrier();\n    for (const Buffers::Impl::Download", "    for (const Buffers::Impl::Download"),
    Mutation("commands-barrier-before-the-host", "vulkan/commands.cpp", "VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &memory,", "VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 0, nullptr,",
             unseen="software drivers write to the memory that the host reads, and the validation layer does not follow reads of the host"),
    Mutation("lists-barrier-after-upload", "methods/device_frame.cpp", "  upload_all(commands, Binding::box_bounds, boxes_);\n  commands.barrier();", "  upload_all(commands, Binding::box_bounds, boxes_);"),
    Mutation("lists-barrier-after-counts", "methods/device_lists.cpp", "record_counts(commands, arguments);\n  commands.barrier();", "record_counts(commands, arguments);"),
    Mutation("lists-barrier-after-sums", "methods/device_lists.cpp", "  commands.barrier();\n  commands.dispatch(sum_sums_", "  commands.dispatch(sum_sums_",
             unseen="a gap: the validation layer 1.3.239 does not report that a shader writes what a shader wrote"),
    Mutation("lists-barrier-before-fill", "methods/device_lists.cpp", "  commands.barrier();\n  record_lists(", "  record_lists("),
    Mutation("masks-barrier-before-counts", "methods/device_lists.cpp", "record_masks(commands, arguments);\n  commands.barrier();", "record_masks(commands, arguments);"),
    Mutation("lights-barrier-after-clearing", "methods/gpu_lights.cpp", "    commands.barrier();\n", ""),
    Mutation("lights-masks-not-cleared", "methods/gpu_lights.cpp", "    commands.fill(Binding::masks, 0, mask_bytes(arguments));\n", ""),
    Mutation("balls-without-padding", "methods/device_frame.cpp", "k_ball_roundoffs = 4.0f", "k_ball_roundoffs = 0.0f"),
    Mutation("cones-without-slack", "methods/device_frame.cpp", "k_cone_slack = 0x1p-19f", "k_cone_slack = 0.0f"),
    Mutation("second-staging-overwrites-the-first", "vulkan/commands.cpp", "  buffers_.uploaded += (bytes + 15) / 16 * 16;\n", ""),
    Mutation("staging-freed-in-use", "vulkan/commands.cpp", "buffers_.outgrown.push_back(staging);", "device_.free(staging);"),
    Mutation("downloads-overlap", "vulkan/commands.cpp", "buffers_.downloads.back().offset + buffers_.downloads.back().bytes;\n  buffers_.downloads.push_back", "buffers_.downloads.back().offset;\n  buffers_.downloads.push_back"),
    Mutation("last-row-of-groups", "vulkan/commands.cpp", "(groups + in_a_row - 1) / in_a_row", "groups / in_a_row"),
    Mutation("limit-not-looked-at", "vulkan/buffers.cpp", "if (bytes > facts.max_buffer_bytes)", "if (false)"),
    Mutation("threads-take-no-turns", "vulkan/commands.cpp", "turn_(device_.turn) {", "turn_(device_.turn) {\n  turn_.unlock();\n  turn_ = {};"),
]

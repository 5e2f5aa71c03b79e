// The loops over the lights of a sample, for structures that define begin_walk(place) and next_light(): the next light of
// the place, or k_none. A structure with a loop of its own for a whole wave defines WALKS_TOGETHER.
//
// No result depends on which lanes run together: each lane handles each of its own lights once, in its own order.

void walk_alone(Place place) {
  begin_walk(place);
  for (uint light = next_light(); light != k_none; light = next_light()) visit(light);
}

// Cell by cell: all lanes in the cell of the first one that is left walk its list together (readFirstLane).
void walk_by_cell(Place place) {
  bool is_left = place.cell >= 0;
  while (is_left) {
    Place first = Place(subgroupBroadcastFirst(place.cell), subgroupBroadcastFirst(place.tile),
                        subgroupBroadcastFirst(place.slice));
    if (first.cell != place.cell) continue;
    walk_alone(first);
    is_left = false;
  }
}

#ifndef WALKS_TOGETHER
// Light by light: the least light that any lane has next is the next one of all lanes that have it.
void walk_together(Place place) {
  uint light = k_none;
  if (place.cell >= 0) {
    begin_walk(place);
    light = next_light();
  }
  for (;;) {
    uint least = subgroupMin(light);
    if (least == k_none) break;
    if (light == least) {
      visit(least);
      light = next_light();
    }
  }
}
#endif

void main() {
  uint index = invocation_index();
  if (index >= args.samples) return;
  sample_position = position_of(index);
  Place place = place_of(index, sample_position);
  if (k_walking == k_by_light)
    walk_together(place);
  else if (k_walking == k_by_cell)
    walk_by_cell(place);
  else if (place.cell >= 0)
    walk_alone(place);
  write_found(index);
}

// Indices of 8, 16 or 32 bits, read as words: devices need not have narrower ones.
layout(std430, set = 0, binding = 5) readonly buffer Indices { uint indices[]; };

uint index_at(uint entry) {
  if (k_index_shift == 0) return indices[entry >> 2] >> (entry & 3u) * 8 & 0xffu;
  if (k_index_shift == 1) return indices[entry >> 1] >> (entry & 1u) * 16 & 0xffffu;
  return indices[entry];
}

// The sum of the counts of a header, from its second word on: points and spots, then boxes.
#define SUM_OF_COUNTS(headers, header)                                                                              \
  ((k_has_wide_counts ? headers[header + 1] + headers[header + 2]                                                   \
                      : (headers[header + 1] & 0xffffu) + (headers[header + 1] >> 16)) +                            \
   (k_has_boxes ? headers[header + (k_has_wide_counts ? 3 : 2)] : 0u))

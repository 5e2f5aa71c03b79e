#include "gpu/user_shaders/spirv_module.h"

#include <algorithm>
#include <cstring>
#include <set>

#include "core/error.h"
#include "core/text.h"

#if CLUSTERBENCH_WITH_SPIRV_TOOLS
#include <spirv-tools/libspirv.hpp>
#endif

namespace clusterbench::gpu {
namespace {

constexpr std::uint32_t k_magic = 0x07230203u, k_magic_swapped = 0x03022307u, k_newest_version = 0x00010600u;
constexpr std::size_t k_header = 5;

struct Op {
  enum : std::uint32_t {
    name = 5,
    entry_point = 15,
    execution_mode = 16,
    capability = 17,
    type_bool = 20,
    type_int = 21,
    type_float = 22,
    type_vector = 23,
    type_matrix = 24,
    type_array = 28,
    type_runtime_array = 29,
    type_struct = 30,
    type_pointer = 32,
    constant = 43,
    constant_composite = 44,
    spec_constant_true = 48,
    spec_constant_false = 49,
    spec_constant = 50,
    spec_constant_composite = 51,
    variable = 59,
    decorate = 71,
    member_decorate = 72,
    bitcast = 124,
    execution_mode_id = 331
  };
};
struct Decoration {
  enum : std::uint32_t {
    spec_id = 1,
    block = 2,
    buffer_block = 3,
    array_stride = 6,
    matrix_stride = 7,
    built_in = 11,
    binding_number = 33,
    descriptor_set = 34,
    offset = 35
  };
};
constexpr std::uint32_t k_compute = 5, k_local_size = 17, k_local_size_id = 38, k_workgroup_size = 25;
struct Storage {
  enum : std::uint32_t { uniform_constant = 0, uniform = 2, workgroup = 4, push_constant = 9, storage_buffer = 12 };
};

struct TypeOf {
  std::uint32_t op = 0;
  std::vector<std::uint32_t> operands{};
};

class ModuleReader {
 public:
  ModuleReader(SpirvModule& out, const std::string& file) : out_(out), file_(file) {}

  void read() {
    const std::vector<std::uint32_t>& words = out_.words;
    for (std::size_t at = k_header; at < words.size();) {
      const std::uint32_t count = words[at] >> 16;
      if (count == 0 || count > words.size() - at)
        refuse(at, "an instruction of " + number_of(count, "word") + " does not fit into the file");
      instruction(words[at] & 0xffffu, std::span(words).subspan(at + 1, count - 1), at);
      at += count;
    }
    finish();
  }

 private:
  using Operands = std::span<const std::uint32_t>;

  [[noreturn]] void refuse(std::size_t word, const std::string& problem) const {
    throw Error(file_, "byte " + std::to_string(word * 4), "is no SPIR-V: " + problem);
  }

  static std::size_t least_operands(std::uint32_t op) {
    switch (op) {
      case Op::entry_point:
      case Op::type_array:
      case Op::type_pointer:
      case Op::variable:
      case Op::constant:
      case Op::spec_constant:
      case Op::type_vector:
      case Op::type_matrix:
      case Op::bitcast:
        return 3;
      case Op::execution_mode:
      case Op::execution_mode_id:
      case Op::decorate:
      case Op::name:
      case Op::type_int:
      case Op::type_float:
      case Op::type_runtime_array:
      case Op::constant_composite:
      case Op::spec_constant_composite:
      case Op::spec_constant_true:
      case Op::spec_constant_false:
        return 2;
      case Op::member_decorate:
        return 3;
      case Op::capability:
      case Op::type_struct:
      case Op::type_bool:
        return 1;
      default:
        return 0;
    }
  }

  void instruction(std::uint32_t op, Operands operands, std::size_t at) {
    if (operands.size() < least_operands(op)) refuse(at, "an instruction is cut off");
    switch (op) {
      case Op::capability:
        out_.capabilities.push_back(operands[0]);
        return;
      case Op::entry_point:
        out_.entries.push_back({text(operands.subspan(2)), operands[0] == k_compute, {}, {1, 1, 1}});
        entry_ids_.push_back(operands[1]);
        return;
      case Op::execution_mode:
      case Op::execution_mode_id:
        return mode(op, operands);
      case Op::name:
        names_[operands[0]] = text(operands.subspan(1));
        return;
      case Op::decorate:
        decorations_[operands[0]][operands[1]] = operands.size() > 2 ? operands[2] : 0;
        return;
      case Op::member_decorate:
        members_[operands[0]][operands[1]][operands[2]] = operands.size() > 3 ? operands[3] : 0;
        return;
      case Op::variable:
        variables_.push_back({operands[1], operands[0], operands[2]});
        return;
      case Op::constant:
      case Op::spec_constant:
        if (operands.size() == 3) out_.numbers[operands[1]] = {operands[2], {}};
        [[fallthrough]];
      case Op::spec_constant_true:
      case Op::spec_constant_false:
        if (op != Op::constant) specialized_.push_back({operands[1], operands[0], operands.size() <= 3});
        return;
      case Op::bitcast:
        (number_kind(operands[0]) == 'f' ? out_.casts_to_float : out_.casts_to_whole) = true;
        return;
      case Op::constant_composite:
      case Op::spec_constant_composite:
        composites_[operands[1]].assign(operands.begin() + 2, operands.end());
        return;
      default:
        if (op >= Op::type_bool && op <= Op::type_pointer)
          types_[operands[0]] = {op, {operands.begin() + 1, operands.end()}};
    }
  }

  void mode(std::uint32_t op, Operands operands) {
    const auto entry = std::ranges::find(entry_ids_, operands[0]);
    const bool is_literal = op == Op::execution_mode && operands[1] == k_local_size,
               is_by_id = op == Op::execution_mode_id && operands[1] == k_local_size_id;
    if (entry == entry_ids_.end() || operands.size() < 5 || (!is_literal && !is_by_id)) return;
    ModuleEntry& of = out_.entries[static_cast<std::size_t>(entry - entry_ids_.begin())];
    std::copy_n(operands.begin() + 2, 3, (is_literal ? of.size : of.size_ids).begin());
  }

  static std::string text(Operands operands) {
    std::string out(operands.size() * 4, '\0');
    std::memcpy(out.data(), operands.data(), out.size());
    return out.substr(0, out.find('\0'));
  }

  std::optional<std::uint32_t> decoration(std::uint32_t id, std::uint32_t which) const {
    const auto of = decorations_.find(id);
    if (of == decorations_.end()) return std::nullopt;
    const auto found = of->second.find(which);
    return found == of->second.end() ? std::nullopt : std::optional(found->second);
  }

  const TypeOf* type(std::uint32_t id) const {
    const auto found = types_.find(id);
    return found == types_.end() ? nullptr : &found->second;
  }

  // Each type is measured once, however many others have it; one that has itself has no size.
  using Sizes = std::map<std::uint32_t, std::uint64_t>;
  template <class Measure>
  static std::uint64_t measured(Sizes& sizes, std::uint32_t id, int depth, Measure measure) {
    constexpr int k_deepest_type = 32;
    constexpr std::uint64_t k_most_bytes = std::uint64_t{1} << 40;
    const auto [found, is_new] = sizes.try_emplace(id, 0);
    if (!is_new || depth > k_deepest_type) return found->second;
    return sizes[id] = std::min<std::uint64_t>(k_most_bytes, measure());
  }

  static std::uint64_t product(std::uint64_t a, std::uint64_t b) {
    constexpr std::uint64_t k_largest_size = std::uint64_t{1} << 40;
    return b == 0 || a <= k_largest_size / b ? a * b : k_largest_size;
  }

  std::uint64_t bytes_of(std::uint32_t id, int depth = 0) {
    const TypeOf* of = type(id);
    if (of == nullptr) return 0;
    return measured(sizes_, id, depth, [&] { return bytes_of_type(id, *of, depth); });
  }
  std::uint64_t bytes_of_type(std::uint32_t id, const TypeOf& of, int depth) {
    const auto operand = [&](std::size_t i) { return i < of.operands.size() ? of.operands[i] : 0; };
    switch (of.op) {
      case Op::type_bool:
        return 4;
      case Op::type_int:
      case Op::type_float:
        return operand(0) / 8;
      case Op::type_vector:
      case Op::type_matrix:
        return product(bytes_of(operand(0), depth + 1), operand(1));
      case Op::type_array:
        return array_bytes(id, operand(0), number(operand(1)), depth);
      case Op::type_runtime_array:
        return array_bytes(id, operand(0), 1, depth);
      case Op::type_struct:
        return struct_bytes(id, of, depth);
      default:
        return 0;
    }
  }
  // The last element has no padding.
  std::uint64_t array_bytes(std::uint32_t id, std::uint32_t element, std::uint64_t count, int depth) {
    const std::uint64_t size = bytes_of(element, depth + 1);
    return count == 0 ? 0 : product(count - 1, decoration(id, Decoration::array_stride).value_or(0)) + size;
  }
  std::uint64_t struct_bytes(std::uint32_t id, const TypeOf& of, int depth) {
    std::uint64_t end = 0;
    const auto members = members_.find(id);
    for (std::uint32_t i = 0; i < of.operands.size(); ++i) {
      std::uint64_t begin = 0, size = bytes_of(of.operands[i], depth + 1);
      if (members != members_.end())
        if (const auto member = members->second.find(i); member != members->second.end()) {
          if (const auto at = member->second.find(Decoration::offset); at != member->second.end()) begin = at->second;
          if (const auto step = member->second.find(Decoration::matrix_stride); step != member->second.end())
            size = std::max<std::uint64_t>(size, matrix_bytes(of.operands[i], step->second));
        }
      end = std::max(end, begin + size);
    }
    return end;
  }
  std::uint64_t matrix_bytes(std::uint32_t id, std::uint64_t step) {
    const TypeOf* of = type(id);
    if (of == nullptr || of->op != Op::type_matrix || of->operands.size() < 2 || of->operands[1] == 0) return 0;
    return (of->operands[1] - 1) * step + bytes_of(of->operands[0], 1);
  }
  // Without strides and offsets, which memory of a group has not.
  std::uint64_t dense_bytes_of(std::uint32_t id, int depth = 0) {
    const TypeOf* of = type(id);
    if (of == nullptr) return 0;
    return measured(dense_sizes_, id, depth, [&] { return dense_bytes_of_type(id, *of, depth); });
  }
  std::uint64_t dense_bytes_of_type(std::uint32_t id, const TypeOf& of, int depth) {
    if (of.op == Op::type_array && of.operands.size() > 1)
      return product(dense_bytes_of(of.operands[0], depth + 1), number(of.operands[1]));
    if (of.op != Op::type_struct) return bytes_of(id, depth);
    std::uint64_t sum = 0;
    for (const std::uint32_t member : of.operands) sum += dense_bytes_of(member, depth + 1);
    return sum;
  }
  std::uint64_t number(std::uint32_t id) const {
    const auto found = out_.numbers.find(id);
    return found == out_.numbers.end() ? 0 : found->second.value;
  }

  void finish() {
    for (const Specialized& one : specialized_)
      if (const auto as = decoration(one.id, Decoration::spec_id)) {
        add_constant({*as, one.is_word, constant_type(one.type)});
        if (const auto found = out_.numbers.find(one.id); found != out_.numbers.end())
          found->second.specialized_as = *as;
      }
    for (const Variable& one : variables_) add(one);
    std::ranges::sort(out_.bindings, {}, [](const ModuleBinding& one) { return std::pair(one.set, one.binding); });
    // A constant that is the size of groups stands for that of each entry.
    for (const auto& [id, parts] : composites_)
      if (decoration(id, Decoration::built_in) == k_workgroup_size && parts.size() == 3)
        for (ModuleEntry& entry : out_.entries) std::copy_n(parts.begin(), 3, entry.size_ids.begin());
  }

  // Several constants may have one id.
  void add_constant(const ModuleConstant& constant) {
    const auto found = std::ranges::find(out_.constants, constant.id, &ModuleConstant::id);
    if (found == out_.constants.end())
      out_.constants.push_back(constant);
    else if (found->is_word = found->is_word && constant.is_word; found->type != constant.type)
      found->type.clear();
  }
  std::string constant_type(std::uint32_t id) const {
    const TypeOf* of = type(id);
    if (of == nullptr) return "";
    if (of->op == Op::type_bool) return "bool";
    if (of->operands.empty() || of->operands[0] != 32) return "";
    if (of->op == Op::type_float) return "f32";
    return of->op != Op::type_int || of->operands.size() < 2 ? "" : of->operands[1] == 0 ? "u32" : "i32";
  }

  // f, i, u of a number or a vector of numbers; ' ' of other types.
  char number_kind(std::uint32_t id) const {
    const TypeOf* of = type(id);
    if (of != nullptr && of->op == Op::type_vector) of = type(of->operands[0]);
    if (of == nullptr) return ' ';
    if (of->op == Op::type_float) return 'f';
    return of->op != Op::type_int || of->operands.size() < 2 ? ' ' : of->operands[1] == 0 ? 'u' : 'i';
  }

  // Finds the numbers of a block of this type from `at` on that begin before `end`. `steps_` and `depth` end what would
  // go on for ever.
  struct Found {
    std::vector<BlockNumber>& numbers;
    std::uint64_t end;
  };
  void find_numbers(std::uint32_t id, std::uint64_t at, std::uint64_t matrix_step, Found& found, int depth = 0) {
    constexpr int k_deepest_block = 32;
    const TypeOf* of = type(id);
    if (of == nullptr || of->operands.empty() || at >= found.end || --steps_ < 0 || depth > k_deepest_block) return;
    const bool is_array = of->op == Op::type_array || of->op == Op::type_runtime_array;
    if (of->op == Op::type_struct) {
      for (std::uint32_t i = 0; i < of->operands.size() && steps_ > 0; ++i)
        find_numbers(of->operands[i], at + member_decoration(id, i, Decoration::offset),
                     member_decoration(id, i, Decoration::matrix_stride), found, depth + 1);
    } else if (is_array || of->op == Op::type_matrix || of->op == Op::type_vector) {
      const std::uint64_t step = is_array                                       ? stride_of_array(id)
                                 : of->op == Op::type_matrix && matrix_step > 0 ? matrix_step
                                                                                : bytes_of(of->operands[0]);
      const std::uint64_t count = of->op == Op::type_runtime_array ? found.end
                                  : is_array                       ? number(of->operands[1])
                                                                   : of->operands[1];
      for (std::uint64_t i = 0; i < count && (i == 0 || step > 0) && at + i * step < found.end && steps_ > 0; ++i)
        find_numbers(of->operands[0], at + i * step, matrix_step, found, depth + 1);
    } else if (const char kind = number_kind(id); kind != ' ') {
      found.numbers.push_back({at, kind, of->operands[0] / 8});
    }
  }
  std::uint64_t stride_of_array(std::uint32_t id) const { return decoration(id, Decoration::array_stride).value_or(0); }
  std::vector<BlockNumber> numbers_of(std::uint32_t block, std::uint64_t end) {
    std::vector<BlockNumber> all;
    Found found{all, end};
    find_numbers(block, 0, 0, found);
    std::ranges::sort(all, {}, &BlockNumber::at);
    return all;
  }
  std::uint32_t member_decoration(std::uint32_t id, std::uint32_t member, std::uint32_t which) const {
    const auto of = members_.find(id);
    if (of == members_.end()) return 0;
    const auto at = of->second.find(member);
    if (at == of->second.end()) return 0;
    const auto found = at->second.find(which);
    return found == at->second.end() ? 0 : found->second;
  }
  static constexpr std::uint64_t k_most_looked_at = 4096;
  void add_arguments(std::uint32_t pointed) {
    const bool is_first = out_.argument_bytes == 0 && !has_arguments_;
    has_arguments_ = true;
    out_.argument_bytes = std::max(out_.argument_bytes, bytes_of(pointed));
    out_.arguments.assign(is_first ? std::min(out_.argument_bytes, k_most_looked_at) : 0, false);
    out_.argument_numbers = numbers_of(pointed, out_.arguments.size());
    for (const BlockNumber& one : out_.argument_numbers) {
      const std::uint64_t end = std::min<std::uint64_t>(one.at + one.bytes, out_.arguments.size());
      for (std::uint64_t i = one.at; i < end; ++i) out_.arguments[i] = true;
    }
  }

  struct Variable {
    std::uint32_t id, type, storage;
  };
  void add(const Variable& one) {
    const TypeOf* pointer = type(one.type);
    std::uint32_t pointed = pointer != nullptr && pointer->op == Op::type_pointer && pointer->operands.size() > 1
                                ? pointer->operands[1]
                                : 0;
    if (one.storage == Storage::push_constant) return add_arguments(pointed);
    if (one.storage == Storage::workgroup) {
      out_.shared_bytes += dense_bytes_of(pointed);
      return;
    }
    if (one.storage != Storage::uniform && one.storage != Storage::storage_buffer &&
        one.storage != Storage::uniform_constant)
      return;
    ModuleBinding found;
    found.set = decoration(one.id, Decoration::descriptor_set).value_or(0);
    found.binding = decoration(one.id, Decoration::binding_number).value_or(0);
    if (const TypeOf* of = type(pointed);
        of != nullptr && (of->op == Op::type_array || of->op == Op::type_runtime_array)) {
      found.is_array = true;
      pointed = of->operands.empty() ? 0 : of->operands[0];
    }
    if (one.storage == Storage::storage_buffer || decoration(pointed, Decoration::buffer_block))
      found.kind = ModuleBinding::Kind::storage;
    else if (one.storage == Storage::uniform && decoration(pointed, Decoration::block))
      found.kind = ModuleBinding::Kind::uniform;
    found.bytes = bytes_of(pointed);
    found.numbers = numbers_of(pointed, k_most_looked_at);
    const auto named = names_.find(one.id), type_named = names_.find(pointed);
    if (named != names_.end()) found.name = named->second;
    if (found.name.empty() && type_named != names_.end()) found.name = type_named->second;
    out_.bindings.push_back(found);
  }

  SpirvModule& out_;
  const std::string& file_;
  std::vector<std::uint32_t> entry_ids_;
  std::map<std::uint32_t, std::string> names_;
  std::map<std::uint32_t, std::map<std::uint32_t, std::uint32_t>> decorations_;
  std::map<std::uint32_t, std::map<std::uint32_t, std::map<std::uint32_t, std::uint32_t>>> members_;
  std::map<std::uint32_t, TypeOf> types_;
  std::map<std::uint32_t, std::vector<std::uint32_t>> composites_;
  struct Specialized {
    std::uint32_t id, type;
    bool is_word;
  };
  std::vector<Specialized> specialized_;
  bool has_arguments_ = false;
  int steps_ = 200000;  // of find_numbers()
  std::vector<Variable> variables_;
  Sizes sizes_, dense_sizes_;
};

void check_beginning(std::span<const std::byte> bytes, const std::string& file) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (text.find("#version") != std::string_view::npos && text.find('\0') == std::string_view::npos)
    throw Error(file, "", "is GLSL; a module is SPIR-V: glslangValidator -V --target-env vulkan1.2 X.comp -o X.spv");
  if (bytes.size() % 4 != 0 || bytes.size() < k_header * 4)
    throw Error(file, "",
                "is no SPIR-V: " + number_of(bytes.size(), "byte") + ", where a module has words of 4, and 5 or more");
}

// SPIRV-Tools knows all rules; drivers may crash where one is broken.
void check_rules([[maybe_unused]] const SpirvModule& module, [[maybe_unused]] const std::string& file) {
#if CLUSTERBENCH_WITH_SPIRV_TOOLS
  const spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_3);
  std::string first;
  spvtools::SpirvTools quiet(SPV_ENV_VULKAN_1_3);
  quiet.SetMessageConsumer([&](spv_message_level_t, const char*, const spv_position_t&, const char* message) {
    if (first.empty()) first = message;
  });
  spvtools::ValidatorOptions options;
  options.SetScalarBlockLayout(true);
  if (quiet.Validate(module.words.data(), module.words.size(), options)) return;
  throw Error(file, "", "breaks a rule of SPIR-V: " + first.substr(0, first.find('\n')));
#endif
}

}  // namespace

SpirvModule read_module(std::span<const std::byte> bytes, const std::string& file) {
  check_beginning(bytes, file);
  SpirvModule out;
  out.words.resize(bytes.size() / 4);
  std::memcpy(out.words.data(), bytes.data(), bytes.size());
  if (out.words[0] == k_magic_swapped)
    throw Error(file, "byte 0", "is SPIR-V of the other byte order; it has to be little-endian");
  if (out.words[0] != k_magic) throw Error(file, "byte 0", "is no SPIR-V: that begins with 03 02 23 07");
  out.version = out.words[1];
  if (out.version > k_newest_version || out.version < 0x00010000u)
    throw Error(file, "byte 4",
                "is SPIR-V of version " + std::to_string(out.version >> 16) + "." +
                    std::to_string(out.version >> 8 & 0xffu) + "; Vulkan 1.3 reads 1.0 to 1.6");
  ModuleReader(out, file).read();
  check_rules(out, file);
  return out;
}

std::optional<std::array<std::uint32_t, 3>> SpirvModule::group_size(
    const ModuleEntry& entry, const std::map<std::uint32_t, std::uint32_t>& given) const {
  std::array<std::uint32_t, 3> out = entry.size;
  for (std::size_t i = 0; i < 3; ++i) {
    if (entry.size_ids[i] == 0) continue;
    const auto found = numbers.find(entry.size_ids[i]);
    if (found == numbers.end()) return std::nullopt;
    out[i] = found->second.value;
    if (!found->second.specialized_as) continue;
    if (const auto set = given.find(*found->second.specialized_as); set != given.end()) out[i] = set->second;
  }
  return out;
}

}  // namespace clusterbench::gpu

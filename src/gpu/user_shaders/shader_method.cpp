#include "gpu/user_shaders/shader_method.h"

#include <algorithm>
#include <bit>
#include <deque>
#include <mutex>
#include <set>

#include "core/error.h"
#include "core/memory.h"
#include "core/text.h"
#include "gpu/device/program.h"
#include "gpu/methods/device_floor.h"
#include "gpu/methods/repeated_work.h"
#include "gpu/user_shaders/known_values.h"
#include "gpu/user_shaders/light_rows.h"
#include "gpu/user_shaders/number_bytes.h"
#include "gpu/user_shaders/shader_lists.h"
#include "gpu/user_shaders/shader_obstacles.h"
#include "gpu/user_shaders/value_places.h"

namespace clusterbench::gpu {
namespace {

using result::ShaderPass;

// Buffers of a device by the method's own; DeviceFloor writes to one that is between them.
std::uint32_t slot_of(std::size_t buffer) {
  return static_cast<std::uint32_t>(buffer < Binding::lists ? buffer : buffer + 1);
}

std::uint64_t whole_words(std::uint64_t bytes) {
  return (bytes + 3) / 4 * 4;
}

// A pass, ready to be dispatched for one frame.
struct ReadyPass {
  const Program* program = nullptr;
  std::array<std::uint32_t, 3> groups{1, 1, 1};
  ByteImage arguments;
};

class ShaderAssigner final : public assign::StructureAssigner {
 public:
  ShaderAssigner(std::shared_ptr<const ShaderFile> file, const assign::Params& params)
      : file_(std::move(file)),
        params_(params),
        device_(&gpu::device()),
        buffers_(*device_),
        floor_(*device_),
        programs_(record().passes.size()),
        constants_(record().passes.size()),
        images_(record().buffers.size()) {}

  std::unique_ptr<assign::LightStructure> make_structure() const override {
    const result::Json& first = record().lists.front();
    const bool has_type = first.contains("entries") && first["entries"].contains("type");
    const std::uint32_t bits =
        has_type ? 8 * static_cast<std::uint32_t>(bytes_of_number(first["entries"]["type"].get<std::string>())) : 32;
    // Parts together may have more lights in a cell than there is room for in one of them.
    const bool has_parts = record().lists.size() > 1;
    return std::make_unique<ShaderLists>(has_parts ? "packed" : first["layout"].get<std::string>(),
                                         std::min(bits, 32u));
  }

  void build(const grid::Grid& grid, const assign::LightKinds&) override {
    grid_ = &grid;
    is_new_ = true;
    check_grid(grid);
  }

  void assign(const assign::FrameInput& input, assign::LightStructure& out) override {
    try {
      assign_frame(input, static_cast<ShaderLists&>(out));
    } catch (const DeviceError&) {
      throw;
    } catch (const Error& error) {  // of this frame: it ends the method's cases, and not the run
      const std::string text = text_at(error.where(), error.message());
      if (error.where() == "limits.memory_mib" || error.where() == "device") throw DeviceError(text);
      throw ShaderFault(text);  // what the description says does not fit together
    }
  }

  std::uint64_t tests_done() const override { return tests_; }
  const assign::DeviceSpans* device_spans() const override { return &spans_; }
  void repeat_on_device(const assign::DeviceRepeats& repeats) override {
    repeats_ = repeats;
    if (repeats.caches == assign::DeviceRepeats::Caches::cold) device_->reserve_flushed();
  }
  double device_floor_ns() override { return floor_.measured_ns(buffers_, spans_, repeats_); }
  std::optional<double> device_build_ns() override {
    if (std::ranges::none_of(record().passes, [&](const ShaderPass& pass) { return file_->is_build(pass); }))
      return std::nullopt;
    return run_build({.caches = repeats_.caches, .run = repeats_.build});
  }
  std::vector<assign::ShaderStatistic> shader_statistics() const override {
    std::vector<assign::ShaderStatistic> all;
    for (const std::unique_ptr<Program>& program : programs_)
      if (program)
        for (assign::ShaderStatistic& told : program->statistics()) all.push_back(std::move(told));
    return all;
  }
  std::size_t scratch_bytes() const override {
    std::size_t bytes = buffers_.all_bytes();
    for (const ByteImage& image : images_) bytes += image.capacity();
    return bytes;
  }

 private:
  const result::ShaderMethod& record() const { return file_->record; }

  [[noreturn]] void refuse(const std::string& where, const std::string& problem) const {
    throw Error("", where, problem);
  }
  // What another device may have.
  [[noreturn]] void refuse_here(const std::string& where, const std::string& problem) const {
    throw DeviceError(text_at(where, problem));
  }
  std::string text_at(const std::string& where, const std::string& problem) const {
    return file_->path.string() + ": " + (where.empty() ? "" : where + ": ") + problem;
  }

  // --- The grid ---

  // Slices that follow a frame's lights may fit in one frame and not in the next.
  void check_grid(const grid::Grid& grid) const {
    if (const std::string reason = grid_obstacle(*file_, grid); !reason.empty())
      throw DeviceError(file_->path.string() + ": " + reason);
  }

  // --- A frame ---

  void assign_frame(const assign::FrameInput& input, ShaderLists& out) {
    const FrameValues values(record(), params_, input.frame, grid_->screen(), input.lights);
    prepare_buffers(values, input.lights);
    prepare_images(values, input.lights);
    for (std::size_t i = 0; i < record().passes.size(); ++i) prepare_program(i, values);
    prepare_passes(values);
    if (is_new_) run_build({});
    is_new_ = false;
    const std::vector<layout::ListPart> parts = list_parts(values);
    run_frame(parts);
    decode(parts, input.lights, out);
    tests_ = record().tests ? amount_of(result::Json(*record().tests), values.number(), "/tests") : 0;
  }

  // Sizes, then room. All are looked at before any memory is taken.
  void prepare_buffers(const FrameValues& values, const view::LightArrays& lights) {
    bytes_.clear();
    std::uint64_t sum = 0;
    for (const auto& [name, buffer] : record().buffers) {
      bytes_.push_back(amount_of(buffer.bytes, values.number(), "/buffers/" + name + "/bytes"));
      if (bytes_.back() > device_->facts().max_buffer_bytes)
        refuse_here("/buffers/" + name + "/bytes", "is " + std::to_string(bytes_.back()) + " here; " +
                                                       device_->facts().name + " allows " +
                                                       std::to_string(device_->facts().max_buffer_bytes));
      sum += bytes_.back();
    }
    check_memory("bytes of a shader's buffers", sum, 1, "make them smaller, or use fewer lights or cells");
    for (std::size_t i = 0; i < record().lights.rows.size(); ++i) {
      const result::ShaderLightRows& rows = record().lights.rows[i];
      const std::uint64_t needed = bytes_of_lights(rows, lights.boxes.first);
      if (needed > bytes_[file_->buffer_index(rows.buffer)])
        refuse("/lights/rows/" + std::to_string(i),
               "take " + number_of(needed, "byte") + " for " + number_of(lights.boxes.first, "light") + "; buffer '" +
                   rows.buffer + "' has " + std::to_string(bytes_[file_->buffer_index(rows.buffer)]));
    }
    for (std::size_t i = 0; i < bytes_.size(); ++i) {
      if (device_bytes(i) > buffers_.bytes(slot_of(i))) is_new_ = true;  // its contents are lost
      buffers_.reserve(slot_of(i), device_bytes(i), ("buffer '" + record().buffers[i].first + "'").c_str());
    }
  }
  // An empty buffer cannot be bound.
  std::uint64_t device_bytes(std::size_t buffer) const {
    constexpr std::uint64_t k_least = 16;
    return std::max(whole_words(bytes_[buffer]), k_least);
  }

  using Places = std::vector<std::optional<ValuePlace>>;

  void prepare_images(const FrameValues& values, const view::LightArrays& lights) {
    std::vector<Places> places(images_.size());
    for (std::size_t i = 0; i < images_.size(); ++i) {
      images_[i].clear();
      const auto& [name, buffer] = record().buffers[i];
      if (buffer.values)
        places[i] = write_values(*buffer.values, values, bytes_[i], "/buffers/" + name + "/values", images_[i]);
    }
    check_light_places(places, lights.boxes.first);
    for (std::size_t i = 0; i < record().lights.rows.size(); ++i) {
      const result::ShaderLightRows& rows = record().lights.rows[i];
      write_lights(record(), rows, lights, images_[file_->buffer_index(rows.buffer)],
                   "/lights/rows/" + std::to_string(i));
    }
  }
  // Lights that share bytes with values, or with other rows of their buffer.
  void check_light_places(const std::vector<Places>& values, std::uint64_t lights) const {
    const std::vector<result::ShaderLightRows>& all = record().lights.rows;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const LightPlaces rows = places_of_lights(all[i], lights, "/lights/rows/" + std::to_string(i));
      check_apart(values[file_->buffer_index(all[i].buffer)], "/buffers/" + all[i].buffer + "/values", rows);
      for (std::size_t j = 0; j < i; ++j)
        if (all[j].buffer == all[i].buffer)
          check_apart(places_of_lights(all[j], lights, "/lights/rows/" + std::to_string(j)), rows);
    }
  }
  // `room`: bytes that there are.
  static Places write_values(const std::vector<result::ShaderValue>& all, const FrameValues& values, std::uint64_t room,
                             const std::string& pointer, ByteImage& out) {
    Places places;
    std::vector<std::vector<double>> numbers;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const std::string where = pointer + "/" + std::to_string(i);
      numbers.push_back(values.numbers(all[i].is, where + "/is"));
      places.push_back(place_of(all[i], amount_of(all[i].at, values.number(), where + "/at"), numbers.back().size()));
      check_room(*places.back(), room, where);
    }
    check_overlaps(places, pointer);
    for (std::size_t i = 0; i < all.size(); ++i)
      out.write(places[i]->at, all[i].type, all[i].step.value_or(0), numbers[i],
                pointer + "/" + std::to_string(i) + "/is");
    return places;
  }

  // --- Passes ---

  using Constants = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

  Constants constants_of(const ShaderPass& pass, const FrameValues& values, const std::string& where) const {
    Constants out;
    if (!pass.constants) return out;
    for (std::size_t i = 0; i < pass.constants->size(); ++i) {
      const result::ShaderConstant& one = (*pass.constants)[i];
      const std::string at = where + "/constants/" + std::to_string(i) + "/is";
      out.emplace_back(one.id, word_of_constant(one, number_of_formula(one.is, values.number(), at), at));
    }
    return out;
  }

  std::array<std::uint32_t, 3> group_size_of(std::size_t index) const {
    const ShaderPass& pass = record().passes[index];
    const Constants& constants = constants_[index];
    // Where it is computed the file is refused.
    return *file_->module(pass).group_size(file_->entry(pass), {constants.begin(), constants.end()});
  }

  void check_group(std::size_t index) const {
    const std::array<std::uint32_t, 3> size = group_size_of(index);
    const DeviceFacts& facts = device_->facts();
    const std::uint64_t all = std::uint64_t{size[0]} * size[1] * size[2];
    bool fits = all >= 1 && all <= facts.max_group_size;
    for (std::size_t axis = 0; axis < 3; ++axis) fits = fits && size[axis] <= facts.max_group_sizes[axis];
    if (fits) return;
    refuse_here("/passes/" + std::to_string(index) + "/module",
                record().passes[index].module + " has groups of " + text_of(size) + " invocations; " + facts.name +
                    " allows " + std::to_string(facts.max_group_size) + ", along the axes " +
                    text_of(facts.max_group_sizes));
  }
  static std::string text_of(const std::array<std::uint32_t, 3>& size) {
    return std::to_string(size[0]) + " x " + std::to_string(size[1]) + " x " + std::to_string(size[2]);
  }

  // Made again where constants have changed, which they do with the grid alone.
  void prepare_program(std::size_t index, const FrameValues& values) {
    if (!is_new_ && programs_[index]) return;
    const ShaderPass& pass = record().passes[index];
    Constants constants = constants_of(pass, values, "/passes/" + std::to_string(index));
    if (programs_[index] && constants == constants_[index]) return;
    constants_[index] = std::move(constants);
    check_group(index);
    const SpirvModule& module = file_->module(pass);
    ProgramCode code{.name = pass.module, .words = module.words, .entry = pass.entry.value_or("main")};
    code.constants = constants_[index];
    code.argument_bytes = static_cast<std::uint32_t>(whole_words(module.argument_bytes));
    for (const result::ShaderBinding& binding : pass.bindings)
      code.bindings.push_back({binding.set.value_or(0), binding.binding,
                               binding_in(module, binding).kind == ModuleBinding::Kind::uniform,
                               slot_of(file_->buffer_index(binding.buffer))});
    programs_[index].reset();
    programs_[index] = std::make_unique<Program>(*device_, code);
  }
  static const ModuleBinding& binding_in(const SpirvModule& module, const result::ShaderBinding& binding) {
    return *std::ranges::find_if(module.bindings, [&](const ModuleBinding& one) {
      return one.set == binding.set.value_or(0) && one.binding == binding.binding;
    });
  }

  void prepare_passes(const FrameValues& values) {
    passes_.clear();
    for (std::size_t i = 0; i < record().passes.size(); ++i) {
      const ShaderPass& pass = record().passes[i];
      const std::string where = "/passes/" + std::to_string(i);
      bind(i, where);
      ReadyPass ready;
      ready.program = programs_[i].get();
      ready.groups = groups_of(i, values, where);
      ready.arguments.grow(whole_words(file_->module(pass).argument_bytes));
      if (pass.push)
        write_values(*pass.push, values, file_->module(pass).argument_bytes, where + "/push", ready.arguments);
      passes_.push_back(std::move(ready));
    }
  }

  void bind(std::size_t index, const std::string& where) {
    const ShaderPass& pass = record().passes[index];
    std::vector<std::uint64_t> seen;
    for (std::size_t i = 0; i < pass.bindings.size(); ++i) {
      const std::size_t buffer = file_->buffer_index(pass.bindings[i].buffer);
      const ModuleBinding& binding = binding_in(file_->module(pass), pass.bindings[i]);
      const std::string at = where + "/bindings/" + std::to_string(i);
      if (bytes_[buffer] > 0 && binding.bytes > whole_words(bytes_[buffer]))
        refuse(at, pass.module + " reads " + number_of(binding.bytes, "byte") + " there; buffer '" +
                       pass.bindings[i].buffer + "' has " + std::to_string(bytes_[buffer]));
      if (binding.kind == ModuleBinding::Kind::uniform && bytes_[buffer] > device_->facts().max_uniform_bytes)
        refuse_here(at, "is a uniform buffer of " + number_of(bytes_[buffer], "byte") + "; " + device_->facts().name +
                            " allows " + std::to_string(device_->facts().max_uniform_bytes));
      seen.push_back(device_bytes(buffer));
    }
    programs_[index]->bind(buffers_, seen);
  }

  std::array<std::uint32_t, 3> groups_of(std::size_t index, const FrameValues& values, const std::string& where) const {
    const ShaderPass& pass = record().passes[index];
    const std::vector<result::Json>& given = pass.groups ? *pass.groups : *pass.invocations;
    const std::array<std::uint32_t, 3> size =
        pass.groups ? std::array<std::uint32_t, 3>{1, 1, 1} : group_size_of(index);
    std::array<std::uint32_t, 3> out{1, 1, 1};
    for (std::size_t axis = 0; axis < given.size(); ++axis) {
      const std::string at = where + (pass.groups ? "/groups/" : "/invocations/") + std::to_string(axis);
      const std::uint64_t count = amount_of(given[axis], values.number(), at),
                          groups = count / size[axis] + (count % size[axis] == 0 ? 0 : 1);
      if (groups > device_->facts().max_groups[axis])
        refuse_here(at, "makes " + number_of(groups, "group") + "; " + device_->facts().name + " allows " +
                            std::to_string(device_->facts().max_groups[axis]) + " along this axis");
      out[axis] = static_cast<std::uint32_t>(groups);
    }
    return out;
  }

  // --- Work on the device ---

  void upload_images(Commands& commands) const {
    for (std::size_t i = 0; i < images_.size(); ++i)
      commands.upload(slot_of(i), images_[i].bytes().data(), images_[i].bytes().size());
    commands.barrier();
  }

  void record_passes(Commands& commands, bool is_build) const {
    for (std::size_t i = 0; i < passes_.size(); ++i) {
      if (file_->is_build(record().passes[i]) != is_build) continue;
      commands.barrier();
      commands.dispatch(*passes_[i].program, passes_[i].arguments.bytes(), passes_[i].groups);
    }
  }

  // Fills all buffers, so that a build begins with the same contents, and runs the passes of the build.
  double run_build(const assign::DeviceRepeats& repeats) {
    Commands commands(*device_, buffers_);
    for (std::size_t i = 0; i < bytes_.size(); ++i)
      commands.fill(slot_of(i), record().buffers[i].second.fill.value_or(0), device_bytes(i));
    commands.barrier();
    upload_images(commands);
    RepeatedWork work(commands, repeats);
    work.record([] {}, [&] { record_passes(commands, true); });
    commands.run();
    return work.spans().run_ns;
  }

  void record_frame(Commands& commands) const {
    for (std::size_t i = 0; i < bytes_.size(); ++i)
      if (record().buffers[i].second.clear.value_or(false))
        commands.fill(slot_of(i), record().buffers[i].second.fill.value_or(0), device_bytes(i));
    record_passes(commands, false);
  }

  std::vector<layout::ListPart> list_parts(const FrameValues& values) const {
    std::vector<layout::ListPart> parts;
    for (std::size_t i = 0; i < record().lists.size(); ++i) {
      const std::string where = "/lists/" + std::to_string(i);
      parts.push_back({lists_of(record().lists[i], values.number(), where), where});
    }
    return parts;
  }
  static std::set<std::string> buffers_in(const std::vector<layout::ListPart>& parts) {
    std::set<std::string> names;
    for (const layout::ListPart& part : parts) {
      if (part.lists.rows) names.insert(part.lists.rows->buffer);
      if (part.lists.entries && part.lists.entries->buffer) names.insert(*part.lists.entries->buffer);
      if (part.lists.ranges) names.insert(part.lists.ranges->buffer);
      if (part.lists.nodes) names.insert(part.lists.nodes->buffer);
    }
    return names;
  }

  void run_frame(const std::vector<layout::ListPart>& parts) {
    const std::set<std::string> names = buffers_in(parts);
    Commands commands(*device_, buffers_);
    RepeatedWork work(commands, repeats_);
    work.record([&] { upload_images(commands); }, [&] { record_frame(commands); });
    for (const std::string& name : names)
      commands.download(slot_of(file_->buffer_index(name)), device_bytes(file_->buffer_index(name)));
    commands.run();
    spans_ = work.spans();
    read_.clear();
    std::uint32_t download = 0;
    for (const std::string& name : names) {
      const auto bytes = std::as_bytes(commands.downloaded(download++));
      const std::uint64_t size = bytes_[file_->buffer_index(name)];
      read_.push_back({name, "", 0, {bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)}});
    }
  }

  // --- Lists ---

  void decode(const std::vector<layout::ListPart>& parts, const view::LightArrays& lights, ShaderLists& out) {
    const result::ShaderCells cells = record().cells.value_or(result::ShaderCells{});
    const layout::Shape shape{grid_->cells(),
                              {cells.axes.value_or("xyz"), cells.first_row.value_or("top") == "bottom",
                               cells.first_slice.value_or("near") == "far"},
                              lights.boxes.first};
    ShaderLists::Contents contents;
    if (record().counts_dropped.value_or(false))
      for (const layout::ListPart& part : parts) {
        const Dropped dropped = cut_counts(part.lists, rows_of(part), read_);
        contents.dropped_pairs += dropped.pairs;
        contents.overflowing_cells += dropped.cells;
      }
    layout::Decoded decoded = layout::decode(parts, read_, shape);
    if (!decoded.faults.are_readable()) refuse_faults(decoded.faults, shape.cells);
    contents.repeated_pairs = decoded.faults.twice;
    contents.lists = std::move(decoded.lists);
    for (const layout::ListPart& part : parts) add_use(part, contents);
    spans_.result_bytes = 0;
    for (const ShaderBufferUse& use : contents.buffers) spans_.result_bytes += use.used * use.element_bytes;
    out.take(std::move(contents), *grid_, lights, parts.front().lists.per_cell.value_or(0));
  }
  std::uint64_t rows_of(const layout::ListPart& part) const {
    const Vec3i cells = grid_->cells();
    const std::uint64_t tiles = static_cast<std::uint64_t>(cells.x) * static_cast<std::uint64_t>(cells.y);
    const bool is_of_tiles = part.lists.per_tile.value_or(false) || part.lists.layout.starts_with("bits_and");
    return is_of_tiles ? tiles : tiles * static_cast<std::uint64_t>(cells.z);
  }
  // An entry is a light index, a node or a word of bits.
  void add_use(const layout::ListPart& part, ShaderLists::Contents& contents) const {
    for (const ShaderBufferUse& use : buffer_use(part.lists, rows_of(part), contents.lists.pair_count(), read_)) {
      contents.buffers.push_back(use);
      if (use.is_header) continue;
      contents.entries += use.entries;
      contents.entry_room += use.entry_room;
    }
  }

  [[noreturn]] void refuse_faults(const layout::Faults& faults, Vec3i cells) const {
    std::string text = fault_text(faults.first.front(), cells);
    if (faults.count > 1) text += "; " + number_of(faults.count - 1, "value") + " more cannot be right";
    throw ShaderFault(file_->path.string() + ": /lists: " + text + advice_for(faults.first.front()));
  }
  // Where a count is above its room.
  std::string advice_for(const layout::Fault& fault) const {
    if (fault.message.find(" is above ") == std::string::npos || record().counts_dropped.value_or(false)) return "";
    std::string text;
    for (const result::Json& part : record().lists)
      if (part.contains("per_cell") && part["per_cell"].is_string())
        text += "; per_cell is '" + part["per_cell"].get<std::string>() + "', of which a parameter can be larger";
    return text + "; \"counts_dropped\": true allows counts that go on where there is no more room";
  }
  static std::string fault_text(const layout::Fault& fault, Vec3i cells) {
    const auto cell = static_cast<int>(fault.cell);
    const Vec3i at{cell % cells.x, cell / cells.x % cells.y, cell / cells.x / cells.y};
    return "buffer '" + (fault.buffer == nullptr ? "" : fault.buffer->name) + "', byte " + std::to_string(fault.byte) +
           ", cell (" + std::to_string(at.x) + ", " + std::to_string(at.y) + ", " + std::to_string(at.z) +
           "): " + fault.message;
  }

  std::shared_ptr<const ShaderFile> file_;
  assign::Params params_;
  Device* device_;
  Buffers buffers_;
  DeviceFloor floor_;
  std::vector<std::unique_ptr<Program>> programs_;  // by pass
  std::vector<Constants> constants_;
  std::vector<ByteImage> images_;     // by buffer: what the host writes
  std::vector<std::uint64_t> bytes_;  // by buffer
  std::vector<ReadyPass> passes_;
  std::vector<layout::Buffer> read_;
  const grid::Grid* grid_ = nullptr;
  bool is_new_ = true;
  std::uint64_t tests_ = 0;
  assign::DeviceRepeats repeats_;
  assign::DeviceSpans spans_;
};

std::vector<assign::ParamSpec> params_of(const result::ShaderMethod& method) {
  std::vector<assign::ParamSpec> params;
  if (!method.parameters) return params;
  for (const result::ShaderParameter& one : *method.parameters)
    params.push_back({.name = one.name,
                      .summary = one.summary,
                      .default_value = one.default_value,
                      .unit = one.unit.value_or(""),
                      .min = one.min,
                      .max = one.max,
                      .choices = {},
                      .whole = one.whole.value_or(true)});
  return params;
}

std::vector<grid::Kind> kinds_of(const result::ShaderMethod& method) {
  std::vector<grid::Kind> kinds;
  for (const std::string& name : method.grids.value_or(std::vector<std::string>{"frustum"}))
    kinds.push_back(name == "distance" ? grid::Kind::distance : grid::Kind::frustum);
  return kinds;
}

struct Added {
  std::filesystem::path path;
  std::unique_ptr<assign::AssignerRegistration> registration;
};

std::deque<Added>& added_methods() {
  static auto& all = *new std::deque<Added>;  // never destroyed: the registry may be before it
  return all;
}

[[noreturn]] void refuse_name(const ShaderFile& file) {
  throw Error(file.path.string(), "/name",
              "is '" + file.record.name + "', the name of another method; choose one of your own");
}

}  // namespace

void check_shader_name(const ShaderFile& file) {
  const assign::AssignerDescriptor* found = assign::find_assigner(file.record.name);
  const bool is_of_shader =
      std::ranges::any_of(added_methods(), [&](const Added& one) { return &one.registration->descriptor() == found; });
  if (found != nullptr && !is_of_shader) refuse_name(file);
}

assign::AssignerDescriptor descriptor_of(const std::shared_ptr<const ShaderFile>& file) {
  const result::ShaderMethod& method = file->record;
  assign::AssignerDescriptor out;
  out.name = method.name;
  out.summary = method.summary;
  out.source = method.source.value_or(file->path.filename().string());
  out.kinds = kinds_of(method);
  out.spots = method.spots.value_or(true);
  out.conservative = method.conservative.value_or(false);
  out.orthographic = method.orthographic.value_or(false);
  out.own_lists = std::ranges::none_of(
      method.lists, [](const result::Json& part) { return part["layout"].get<std::string>().starts_with("bits_and"); });
  out.by_name = true;
  out.on_device = true;
  out.params = params_of(method);
  out.origin = assign::Origin{file->path.string(), file->sha256};
  out.make_own = [file](const assign::Params& params) -> std::unique_ptr<assign::StructureAssigner> {
    return std::make_unique<ShaderAssigner>(file, params);
  };
  out.unfit = [file](const grid::Grid& grid) { return grid_obstacle(*file, grid); };
  out.unavailable = [file](const assign::Params&) { return shader_obstacle(*file); };
  return out;
}

const assign::AssignerDescriptor& add_shader_method(const std::filesystem::path& path) {
  std::error_code failed;
  const std::filesystem::path whole = std::filesystem::weakly_canonical(path, failed);
  std::deque<Added>& all = added_methods();
  if (const auto found = std::ranges::find(all, whole, &Added::path); found != all.end())
    return found->registration->descriptor();
  auto file = std::make_shared<const ShaderFile>(read_shader_file(path));
  if (assign::find_assigner(file->record.name) != nullptr) refuse_name(*file);
  use_robust_buffers();
  all.push_back({whole, std::make_unique<assign::AssignerRegistration>(descriptor_of(file))});
  return all.back().registration->descriptor();
}

void remove_shader_methods() {
  added_methods().clear();
}

}  // namespace clusterbench::gpu

#pragma once
// A user's own compute shaders as a method: what `--shader FILE` reads. The JSON says how SPIR-V modules beside it are
// bound and dispatched, and how the lists lie that they leave.

#include "result/documents/dump.h"

namespace clusterbench::result {

// A number, or a formula of numbers that are known: cells, lights, cap.
inline About amount(const char* description, const char* unit = "") {
  return About(description, unit)
      .shaped(R"({"anyOf": [{"type": "integer", "minimum": 0}, {"type": "string", "x-formula": true}]})");
}

struct ShaderParameter {
  static About about() { return About("A number that a configuration may set; formulas name it"); }
  RECORD(ShaderParameter);
  FIELD(std::string, name, "Of small letters, digits and _");
  FIELD(std::string, summary, "What it is");
  FIELD_AS("default", double, default_value, About("Its value where nobody sets it").finite());
  FIELD(double, min, About("").finite());
  FIELD(double, max, About("").finite());
  FIELD(std::optional<bool>, whole, "Only whole numbers; absent: true");
  FIELD(std::optional<std::string>, unit, "Absent: none");
  END_RECORD;
};

struct ShaderValue {
  static constexpr const char* k_definition = "value";
  static About about() { return About("A value in a buffer or among push constants"); }
  RECORD(ShaderValue);
  FIELD(Json, at, amount("First byte", "bytes"));
  FIELD(std::string, type,
        About("Of each number").one_of({"u8", "i8", "u16", "i16", "u32", "i32", "f16", "f32", "f64"}));
  FIELD(std::string, is, "A known value, as inverse_projection (16 numbers) or slice_scale (one), or a formula");
  FIELD(std::optional<std::uint64_t>, step, "Of several numbers: from one to the next; absent: the size of the type",
        "bytes");
  END_RECORD;
};

struct ShaderConstant {
  RECORD(ShaderConstant);
  FIELD(std::uint32_t, id, "As the module has it (constant_id in GLSL)");
  FIELD(std::string, is, "A known number, or a formula");
  FIELD(std::optional<std::string>, type, About("Absent: u32").one_of({"u32", "i32", "f32", "bool"}));
  END_RECORD;
};

struct ShaderBuffer {
  static About about() {
    return About(
        "What shaders bind. Begins with zeros, and keeps its contents from frame to frame unless it is cleared");
  }
  RECORD(ShaderBuffer);
  FIELD(Json, bytes, amount("Size", "bytes"));
  FIELD(std::optional<bool>, clear, "Filled before the passes of each frame, as a part of their time; absent: false");
  FIELD(std::optional<std::uint32_t>, fill,
        "The 32-bit word that it is filled with, first and where it is cleared; absent: 0");
  FIELD(std::optional<std::vector<ShaderValue>>, values, "Written by the host in each frame, as a part of the upload");
  END_RECORD;
};

struct ShaderLightField {
  RECORD(ShaderLightField);
  FIELD(std::uint64_t, at, "First byte within the light's row", "bytes");
  FIELD(std::string, type,
        About("Of each number").one_of({"u8", "i8", "u16", "i16", "u32", "i32", "f16", "f32", "f64"}));
  FIELD(std::string, is,
        About("position, direction: three numbers, one after the other (direction-to-light: the other way); cone-*: of "
              "the angle from axis to edge; points have direction 0 0 0 and a cone of 180 degrees; type: 0 of points, "
              "1 of spots; index: of the light")
            .one_of({"position", "x", "y", "z", "range", "range-squared", "range-inverse", "range-inverse-squared",
                     "direction", "direction-to-light", "cone-radians", "cone-degrees", "cone-cosine", "cone-sine",
                     "type", "index"}));
  END_RECORD;
};

struct ShaderLightRows {
  RECORD(ShaderLightRows);
  FIELD(std::string, buffer, "Name of one of the buffers");
  FIELD(std::optional<std::uint64_t>, at, "First byte of light 0; absent: 0", "bytes");
  FIELD(std::uint64_t, stride, About("From one light to the next", "bytes").at_least(1));
  FIELD(std::vector<ShaderLightField>, fields, About("Of each light; all other bytes are 0").items(1, 64));
  END_RECORD;
};

struct ShaderLights {
  RECORD(ShaderLights);
  FIELD(std::optional<std::string>, space,
        About("Of positions and directions; view: as `camera.forward` says; absent: view").one_of({"view", "world"}));
  FIELD(
      std::vector<ShaderLightRows>, rows,
      About("Points before spots. One entry is an array of structs; several, in buffers of their own, are arrays side "
            "by side")
          .items(1, 16));
  END_RECORD;
};

struct ShaderCamera {
  static About about() { return About("Convention of the matrices, in the words of a dump"); }
  RECORD(ShaderCamera);
  FIELD(std::optional<std::string>, order, About("As of a dump; absent: columns").one_of({"columns", "rows"}));
  FIELD(std::optional<std::string>, forward, About("As of a dump; absent: -z").one_of({"-z", "+z"}));
  FIELD(std::optional<std::string>, depth, About("As of a dump; absent: 0..1").one_of({"0..1", "-1..1", "1..0"}));
  FIELD(std::optional<std::string>, clip_y, About("As of a dump; absent: up").one_of({"up", "down"}));
  END_RECORD;
};

struct ShaderCells {
  static About about() { return About("How cells are numbered, in the words of a dump's grid"); }
  RECORD(ShaderCells);
  FIELD(std::optional<std::string>, axes,
        About("The fastest first; absent: xyz").one_of({"xyz", "xzy", "yxz", "yzx", "zxy", "zyx"}));
  FIELD(std::optional<std::string>, first_row, About("Absent: top").one_of({"top", "bottom"}));
  FIELD(std::optional<std::string>, first_slice, About("Absent: near").one_of({"near", "far"}));
  END_RECORD;
};

struct ShaderBinding {
  RECORD(ShaderBinding);
  FIELD(std::optional<std::uint32_t>, set, "Descriptor set; absent: 0");
  FIELD(std::uint32_t, binding, "Of the set");
  FIELD(std::string, buffer, "Name of one of the buffers");
  END_RECORD;
};

struct ShaderPass {
  static About about() { return About("A dispatch; the next one sees all that it wrote"); }
  RECORD(ShaderPass);
  FIELD(std::string, module, "File of SPIR-V, relative to the folder of this file");
  FIELD(std::optional<std::string>, entry, "Name of the entry point; absent: main");
  FIELD(std::optional<std::string>, when,
        About("build: only after the projection changed; absent: assign, in each frame").one_of({"build", "assign"}));
  FIELD(std::optional<std::vector<Json>>, groups,
        amount("Groups along x, y and z; those that are left out are 1").items(1, 3));
  FIELD(std::optional<std::vector<Json>>, invocations,
        amount("In place of groups: invocations along x, y and z, rounded up to whole groups").items(1, 3));
  FIELD(std::vector<ShaderBinding>, bindings, About("").items(1, 14));
  FIELD(std::optional<std::vector<ShaderValue>>, push, "Push constants");
  FIELD(std::optional<std::vector<ShaderConstant>>, constants, "Specialization constants");
  END_RECORD;
};

struct ShaderMethod {
  RECORD(ShaderMethod);
  FIELD(int, shader_version, About("Grows whenever a name or a meaning changes").always(1));
  FIELD(std::string, name, "Of the method: small letters, digits and -, at most 40; no built-in method has it");
  FIELD(std::string, summary, "What it does, for `clusterbench list`");
  FIELD(std::optional<std::string>, source, "Engine, paper or address; absent: the file's name");
  FIELD(std::optional<bool>, conservative,
        "true: it promises that no light is lost, and one that is fails the run; absent: lost lights are counted");
  FIELD(std::optional<bool>, orthographic, "It takes orthographic cameras; absent: false");
  FIELD(std::optional<bool>, spots, "It takes spots, if only as balls of their range; absent: true");
  FIELD(std::optional<std::vector<std::string>>, grids,
        About("Kinds of grid; absent: frustum alone").one_of({"frustum", "distance"}).items(1, 2));
  FIELD(std::optional<std::string>, tiles,
        About("even: it takes all tiles for equally large; a grid whose last ones are cut off is skipped. absent: any")
            .one_of({"any", "even"}));
  FIELD(std::optional<std::string>, slices,
        About("Those that it computes itself: boundaries near * (far / near)^(k / n), or evenly spaced; a grid with "
              "others is skipped. absent: any")
            .one_of({"any", "exponential", "linear"}));
  FIELD(std::optional<ShaderCamera>, camera, "");
  FIELD(std::optional<ShaderCells>, cells, "");
  FIELD(std::optional<std::vector<ShaderParameter>>, parameters, About("").items(0, 32));
  FIELD(ByName<ShaderBuffer>, buffers, About("By name, at most 14").each(""));
  FIELD(ShaderLights, lights, "How the lights of a frame are given");
  FIELD(std::vector<ShaderPass>, passes, About("One after the other").items(1, 32));
  FIELD(
      std::vector<Json>, lists,
      About("What the passes leave, as the `lists` of a dump (not inline); where a dump has a whole number, a formula "
            "may stand")
          .items(1, 16));
  FIELD(std::optional<bool>, counts_dropped,
        "Counts go on where a list (fixed) or the buffer of entries (packed) is full: what is beyond is dropped, and "
        "counted. absent: such a count is a fault");
  FIELD(std::optional<std::string>, tests,
        "Tests of a light against a cell in a frame, as a formula; absent: not told");
  END_RECORD;
};

Json shader_schema();

extern template const Type& type_of<ShaderMethod>();

}  // namespace clusterbench::result

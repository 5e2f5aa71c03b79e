#pragma once
// Shaders compiled by glslang and run: from SPIR-V spirv-cross makes C++. Without these programs the tests are skipped.

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace clusterbench::report::testing {

inline bool has_program(const char* name) {
  return std::system((std::string("command -v ") + name + " >/dev/null 2>&1").c_str()) == 0;
}

// What C++ of spirv-cross includes, as far as a shader with two buffers and no other inputs needs it.
inline constexpr const char* k_interface = R"(#pragma once
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
struct spirv_cross_shader {
  static inline void* buffers[64];
  template <class R> void register_resource(R& resource, unsigned, unsigned binding) { resource.set(buffers[binding]); }
};
using spirv_cross_shader_t = spirv_cross_shader;
struct spirv_cross_interface {
  spirv_cross_shader* (*construct)();
  void (*destruct)(spirv_cross_shader*);
  void (*invoke)(spirv_cross_shader*);
};
namespace spirv_cross {
namespace internal {
template <class T> struct Resource {
  T* at;
  void set(void* to) { at = static_cast<T*>(to); }
  T& get() { return *at; }
};
}  // namespace internal
struct ComputeResources { void init(spirv_cross_shader&) {} };
struct ComputePrivateResources {};
template <class S, class R, int, int, int> struct ComputeShader : spirv_cross_shader {
  S shader{};
  R resources{};
  void invoke() {
    resources.init(*this);
    shader.__res = &resources;
    shader.main();
  }
};
}  // namespace spirv_cross
)";

inline constexpr const char* k_driver = R"(
#include <cstdio>
int main(int, char** files) {
  static uint32_t numbers[INPUTS];
  static int32_t answers[OUTPUTS];
  std::FILE* in = std::fopen(files[1], "rb");
  if (in == nullptr || std::fread(numbers, sizeof numbers, 1, in) != 1) return 2;
  spirv_cross_shader::buffers[0] = numbers;
  spirv_cross_shader::buffers[1] = answers;
  spirv_cross_shader_t* shader = spirv_cross_get_interface()->construct();
  spirv_cross_get_interface()->invoke(shader);
  spirv_cross_get_interface()->destruct(shader);
  std::FILE* out = std::fopen(files[2], "wb");
  return out != nullptr && std::fwrite(answers, sizeof answers, 1, out) == 1 && std::fclose(out) == 0 ? 0 : 3;
}
)";

class ShaderTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!has_program("glslangValidator") || !has_program("spirv-cross"))
      GTEST_SKIP() << "skipped: needs glslangValidator and spirv-cross (Debian: glslang-tools, spirv-cross)";
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  bool does(const std::string& command) const {
    const bool is_done = std::system((command + " >" + path("log") + " 2>&1").c_str()) == 0;
    std::ifstream log(path("log"));
    EXPECT_TRUE(is_done) << command << "\n" << std::string(std::istreambuf_iterator<char>(log), {});
    return is_done;
  }
  bool compiles(const std::string& shader, bool is_hlsl) const {
    write(is_hlsl ? "x.hlsl" : "x.comp", shader);
    return does(is_hlsl ? "glslangValidator -V -D -S comp -e main " + path("x.hlsl") + " -o " + path("x.spv")
                        : "glslangValidator -V -S comp " + path("x.comp") + " -o " + path("x.spv"));
  }
  // What the shader of `compiles` answers to these words.
  std::vector<std::int32_t> answers(const std::vector<std::uint32_t>& words, std::size_t outputs) const {
    std::filesystem::create_directories(folder_ / "spirv_cross");
    write("spirv_cross/internal_interface.hpp", k_interface);
    write("spirv_cross/external_interface.h", "");
    write("driver.inc", k_driver);
    std::ofstream in(path("in"), std::ios::binary);
    in.write(reinterpret_cast<const char*>(words.data()), static_cast<std::streamsize>(4 * words.size()));
    in.close();
    if (!does("spirv-cross --cpp " + path("x.spv") + " --output " + path("x.inc"))) return {};
    write("x.cpp", "#include \"x.inc\"\n#include \"driver.inc\"\n");
    if (!does("c++ -std=c++17 -w -O1 -ffp-contract=off -DINPUTS=" + std::to_string(words.size()) +
              " -DOUTPUTS=" + std::to_string(outputs) + " -I" + path("") + " " + path("x.cpp") + " -o " + path("x")) ||
        !does(path("x") + " " + path("in") + " " + path("out")))
      return {};
    std::vector<std::int32_t> out(outputs);
    std::ifstream file(path("out"), std::ios::binary);
    file.read(reinterpret_cast<char*>(out.data()), static_cast<std::streamsize>(4 * outputs));
    return out;
  }
  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("clusterbench_shaders_" + std::to_string(getpid()));
};

}  // namespace clusterbench::report::testing

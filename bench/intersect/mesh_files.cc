#include <filesystem>
#include <fstream>
#include <sstream>

#include "bench/intersect/mesh.h"
#include "src/base/core/error.h"

namespace lanelight::bench {
namespace {

void Require(bool good, const std::string& path, const char* what) {
  if (!good) throw InputError(path + ": " + what);
}

struct Counts {
  std::size_t vertices = 0, faces = 0;
};

Counts ReadHeader(std::istream& in, const std::string& path) {
  Counts counts;
  std::string line;
  while (std::getline(in, line) && line != "end_header") {
    std::istringstream words(line);
    std::string word, kind;
    words >> word >> kind;
    if (word == "format") Require(kind == "binary_little_endian", path, "not binary");
    if (word == "element" && kind == "vertex") words >> counts.vertices;
    if (word == "element" && kind == "face") words >> counts.faces;
  }
  return counts;
}

void ReadPly(const std::string& path, Mesh& mesh) {
  std::ifstream in(path, std::ios::binary);
  Require(in.good(), path, "cannot open");
  const Counts counts = ReadHeader(in, path);
  mesh.vertices.resize(counts.vertices);
  mesh.triangles.resize(counts.faces);
  in.read(reinterpret_cast<char*>(mesh.vertices.data()),
          static_cast<std::streamsize>(counts.vertices * sizeof(Vec3f)));
  for (auto& triangle : mesh.triangles) {
    char corners = 0;
    in.read(&corners, 1);
    in.read(reinterpret_cast<char*>(triangle.data()), sizeof(triangle));
    Require(corners == 3, path, "a face is not a triangle");
    for (const std::uint32_t v : triangle) {
      Require(v < counts.vertices, path, "bad index");
    }
  }
  Require(in.good(), path, "truncated");
}

void ReadCamera(const std::string& path, Mesh& mesh) {
  std::ifstream in(path);
  Require(in.good(), path, "cannot open");
  const auto read = [&](Vec3f& v) { in >> v.x >> v.y >> v.z; };
  for (std::string key; in >> key;) {
    if (key == "eye") read(mesh.eye);
    if (key == "at") read(mesh.at);
    if (key == "up") read(mesh.up);
    if (key == "fov") in >> mesh.fov;
    if (key == "light") {
      read(mesh.light_corner);
      read(mesh.light_u);
      read(mesh.light_v);
    }
    Require(!in.fail(), path, "a number is missing");
  }
}

}  // namespace

bool HasMesh(const std::string& folder, const std::string& name) {
  return std::filesystem::exists(folder + "/" + name + ".ply");
}

Mesh LoadMesh(const std::string& folder, const std::string& name) {
  Mesh mesh;
  mesh.name = name;
  ReadPly(folder + "/" + name + ".ply", mesh);
  ReadCamera(folder + "/" + name + ".cam", mesh);
  return mesh;
}

}  // namespace lanelight::bench

// mesh_loader.h: one task per file, the largest first, so that the last one to end is a short one.
#include "renderer/mesh_loader.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <filesystem>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "core/error.h"
#include "core/file_io.h"
#include "core/hash.h"
#include "core/parallel.h"
#include "renderer/obj_file.h"
#include "renderer/obj_mesh.h"
#include "renderer/ply_file.h"
#include "renderer/serialized_file.h"

namespace octolux {
namespace {

/// A file, and the requests (their numbers) that want it.
struct FileTask {
  std::string path;
  std::vector<std::size_t> requests;
  double size = 0;  // [bytes]
  std::uint64_t hash = 0;
};

class Loader {
 public:
  Loader(const std::vector<MeshRequest>& requests, const LoadProgress& progress)
      : requests_(requests), progress_(progress), errors_(requests.size()) {
    result_.meshes.resize(requests.size());
  }

  LoadedMeshes load() {
    list_tasks();
    std::vector<std::size_t> order(tasks_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return tasks_[a].size > tasks_[b].size; });
    parallel_for_chunks(std::ssize(order), 1, [&](std::int64_t i, std::int64_t, std::int64_t) {
      run(tasks_[order[static_cast<std::size_t>(i)]]);
    });
    for (const std::exception_ptr& error : errors_) {
      if (error) std::rethrow_exception(error);
    }
    for (const FileTask& task : tasks_) result_.hash = hash64(result_.hash ^ task.hash);
    return std::move(result_);
  }

 private:
  void list_tasks() {
    std::map<std::string, std::size_t> task_of_path;
    for (std::size_t i = 0; i < requests_.size(); ++i) {
      const std::string& path = requests_[i].path;
      const auto [entry, added] = task_of_path.try_emplace(path, tasks_.size());
      if (added) {
        std::error_code unreadable;  // shows when the file is opened
        const auto size = std::filesystem::file_size(path, unreadable);
        tasks_.push_back({path, {}, unreadable ? 0 : static_cast<double>(size)});
        total_size_ += tasks_.back().size;
      }
      tasks_[entry->second].requests.push_back(i);
    }
  }

  /// No exception leaves this: which one would win is chance.
  void run(FileTask& task) {
    std::size_t at = task.requests.front();
    try {
      const bool obj = requests_[at].format == MeshRequest::Format::obj;
      const std::string bytes = obj ? "" : read_file(task.path);
      const std::optional<ObjFile> file =
          obj ? std::optional(read_obj_file(task.path)) : std::nullopt;
      task.hash = obj ? file->hash : hash_bytes(0, bytes);
      for (const std::size_t i : task.requests) {
        at = i;
        result_.meshes[i] = obj ? from_obj(*file, requests_[i]) : from_bytes(bytes, requests_[i]);
      }
    } catch (...) {
      errors_[at] = std::current_exception();
    }
    report(task.size);
  }

  static LoadedMesh from_obj(const ObjFile& file, const MeshRequest& request) {
    if (!request.attributes.empty()) {
      throw Error(request.path + ": an OBJ file has no mesh attribute '" +
                  request.attributes.front() + "'; PLY files may have them");
    }
    ObjMesh loaded = load_obj_mesh(file, request.options);
    apply_creases_and_flip(loaded.mesh, request.options);
    return {std::move(loaded.mesh), std::move(loaded.warnings)};
  }

  static LoadedMesh from_bytes(const std::string& bytes, const MeshRequest& request) {
    LoadedMesh result;
    MeshOptions options = request.options;
    if (request.format == MeshRequest::Format::ply) {
      PlyMesh file = read_ply(request.path, bytes, request.attributes);
      result = {std::move(file.mesh), std::move(file.warnings)};
    } else {
      for (const std::string& name : request.attributes) {
        if (name == "vertex_color") continue;
        throw Error(request.path + ": " + unknown_name("mesh attribute", name, {"vertex_color"}));
      }
      SerializedMesh file =
          read_serialized(request.path, bytes, request.shape_index, !request.attributes.empty());
      options.face_normals |= file.face_normals && !options.max_smooth_angle;
      result.mesh = std::move(file.mesh);
    }
    for (MeshAttribute& a : result.mesh.attributes) {
      if (!clamp(a)) continue;
      result.warnings.push_back(request.path + ": the mesh attribute '" + a.name +
                                "' has values outside [0, 1]; clamped");
    }
    finish_mesh(result.mesh, options, request.path, result.warnings);
    return result;
  }

  /// Attributes are reflectances and weights. Was anything changed?
  static bool clamp(MeshAttribute& attribute) {
    bool changed = false;
    const auto inside = [](float x) { return std::clamp(x, 0.0f, 1.0f); };
    for (Rgb& c : attribute.values) {
      const Rgb clamped{inside(c.r), inside(c.g), inside(c.b)};
      changed |= !(clamped == c);
      c = clamped;
    }
    return changed;
  }

  void report(double size) {
    if (!progress_ || !(total_size_ > 0)) return;
    double done = done_size_.load();
    while (!done_size_.compare_exchange_weak(done, done + size)) continue;
    progress_("reading meshes", (done + size) / total_size_);
  }

  const std::vector<MeshRequest>& requests_;
  const LoadProgress& progress_;
  std::vector<FileTask> tasks_;
  std::vector<std::exception_ptr> errors_;  // per request
  double total_size_ = 0;
  std::atomic<double> done_size_ = 0;
  LoadedMeshes result_;
};

}  // namespace

LoadedMeshes load_meshes(const std::vector<MeshRequest>& requests, const LoadProgress& progress) {
  return Loader(requests, progress).load();
}

}  // namespace octolux

// checkpoint.h. Layout: a head of fixed length, the provenance, the progress, the film's bytes. The
// head holds their fingerprint, so that half a file, or one of another build, is not taken for a
// render.
#include "renderer/checkpoint.h"

#include <fmt/format.h>

#include <cstring>
#include <type_traits>

#include "core/hash.h"
#include "renderer/source_fingerprint.h"

namespace octolux {
namespace {

static_assert(std::is_trivially_copyable_v<Progress>);

struct Head {
  char magic[8] = {'o', 'c', 't', 'o', 'l', 'u', 'x', '1'};
  std::uint64_t provenance_size = 0, progress_size = sizeof(Progress), fingerprint = 0;
};

/// Settings that path tracing does not look at.
bool matters(Integrator integrator, const std::string& name) {
  if (name.starts_with("stop.")) return false;
  return integrator == Integrator::photon || name == "seed" || name == "eye.samples_per_pass";
}

}  // namespace

std::string provenance(const Scene& scene, const RenderConfig& wanted) {
  const FilmSize& f = scene.film;
  const RenderConfig config =
      resolved(wanted, static_cast<std::int64_t>(f.crop_width) * f.crop_height);
  std::string text = fmt::format(
      "octolux {} {}\nscene {:016x}\nfilm {}x{} crop {},{} {}x{}\nintegrator {}\n", OCTOLUX_VERSION,
      source_fingerprint(), scene.hash, f.width, f.height, f.crop_x, f.crop_y, f.crop_width,
      f.crop_height, config.integrator == Integrator::photon ? "photon" : "path");
  visit(config, [&](const std::string& name, const auto& value) {
    if (matters(config.integrator, name)) text += fmt::format("{} {}\n", name, value);
  });
  return text;
}

std::string to_checkpoint(const std::string& provenance, const Progress& progress,
                          const Film& film) {
  std::string body = provenance;
  body.append(reinterpret_cast<const char*>(&progress), sizeof progress);
  body += film.to_bytes();
  Head head;
  head.provenance_size = provenance.size();
  head.fingerprint = hash_bytes(0, body);
  return std::string(reinterpret_cast<const char*>(&head), sizeof head) + body;
}

std::optional<RenderResult> from_checkpoint(std::string_view bytes, const std::string& provenance,
                                            const FilmSize& film) {
  const Head expected;
  Head head;
  if (bytes.size() < sizeof head) return std::nullopt;
  std::memcpy(&head, bytes.data(), sizeof head);
  const std::string_view body = bytes.substr(sizeof head);
  const bool ours =
      std::memcmp(head.magic, expected.magic, sizeof head.magic) == 0 &&
      head.progress_size == expected.progress_size && head.provenance_size == provenance.size() &&
      body.size() >= provenance.size() + sizeof(Progress) &&
      body.substr(0, provenance.size()) == provenance && hash_bytes(0, body) == head.fingerprint;
  if (!ours) return std::nullopt;
  RenderResult result{Film(film.crop_width, film.crop_height), {}, false};
  std::memcpy(&result.progress, body.data() + provenance.size(), sizeof(Progress));
  const std::string_view sums = body.substr(provenance.size() + sizeof(Progress));
  return result.film.from_bytes(sums) ? std::optional(std::move(result)) : std::nullopt;
}

}  // namespace octolux

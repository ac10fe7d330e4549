// run.h. In a run's folder: NNNNNN.exr per snapshot, run.state (renderer/checkpoint.h) and run.json
// (times), written in this order, so that whatever the JSON names is there.
#include "tools/converge/run.h"

#include <fmt/format.h>

#include <cctype>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/error.h"
#include "core/file_io.h"
#include "core/hash.h"
#include "renderer/checkpoint.h"
#include "renderer/picture.h"

namespace octolux {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Time between two savings of an unfinished run.
constexpr std::chrono::seconds kSaveInterval(20);

/// Expected times are uncertain: the next doubling may end this much later than asked.
constexpr double kTimeSlack = 1.1;

double cpu_now() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// A run on disk and in memory.
class RunState final : public RenderObserver {
 public:
  RunState(std::string folder, const Scene& scene, const RenderConfig& config,
           RenderObserver& listener);

  const std::vector<Snapshot>& snapshots() const { return snapshots_; }
  /// Passes of the next snapshot.
  int next() const { return snapshots_.empty() ? 1 : 2 * snapshots_.back().passes; }
  /// Renders up to `passes` and takes a snapshot; false if it was stopped before.
  bool render_to(int passes);
  Run run() const;

  bool pass_done(const Progress& progress, const Film& film) override;

 private:
  /// Passes rendered, also those after the last snapshot.
  int passes() const { return result_ ? result_->progress.passes : 0; }
  void load();
  void load_snapshots(const json& record);
  void save(const Progress& progress, const Film& film) const;
  void take_snapshot();
  std::string file(const std::string& name) const { return (fs::path(folder_) / name).string(); }
  double cpu_seconds() const { return cpu_before_ + (cpu_now() - cpu_start_); }

  std::string folder_;
  const Scene& scene_;
  RenderConfig config_;
  RenderObserver& listener_;
  std::string provenance_;
  std::vector<Snapshot> snapshots_;
  std::optional<RenderResult> result_;
  double cpu_before_ = 0, cpu_start_ = 0;
  std::chrono::steady_clock::time_point last_save_;
};

RunState::RunState(std::string folder, const Scene& scene, const RenderConfig& config,
                   RenderObserver& listener)
    : folder_(std::move(folder)),
      scene_(scene),
      config_(config),
      listener_(listener),
      provenance_(provenance(scene, config)) {
  std::error_code code;
  fs::create_directories(folder_, code);
  check_writable(file("run.json"));
  load();
}

/// What is on disk, as far as it is whole.
void RunState::load() {
  if (!fs::exists(file("run.json")) || !fs::exists(file("run.state"))) return;
  const json record = json::parse(read_file(file("run.json")), nullptr, false);
  result_ = from_checkpoint(read_file(file("run.state")), provenance_, scene_.film);
  if (record.is_object() && result_) load_snapshots(record);
  if (passes() <= next()) return;
  result_.reset();  // pictures are missing that this state is too old to make again
  snapshots_.clear();
  cpu_before_ = 0;
}

void RunState::load_snapshots(const json& record) {
  for (const json& s : record.value("snapshots", json::array())) {
    const Snapshot snapshot{s.value("passes", 0), s.value("seconds", 0.0),
                            s.value("cpu_seconds", 0.0), file(s.value("file", ""))};
    const bool whole = snapshot.passes == next() && snapshot.passes <= passes();
    if (whole && fs::exists(snapshot.file)) snapshots_.push_back(snapshot);
  }
  // The state may be a little ahead of the record.
  const double share = static_cast<double>(passes()) / std::max(1, record.value("passes", 1));
  cpu_before_ = record.value("cpu_seconds", 0.0) * share;
}

void RunState::save(const Progress& progress, const Film& film) const {
  write_file(file("run.state"), to_checkpoint(provenance_, progress, film));
  json record;
  record["passes"] = progress.passes;
  record["cpu_seconds"] = cpu_seconds();
  record["provenance"] = provenance_;
  record["snapshots"] = json::array();
  for (const Snapshot& s : snapshots_) {
    record["snapshots"].push_back({{"passes", s.passes},
                                   {"seconds", s.seconds},
                                   {"cpu_seconds", s.cpu_seconds},
                                   {"file", fs::path(s.file).filename().string()}});
  }
  write_file(file("run.json"), record.dump(2) + "\n");
}

bool RunState::pass_done(const Progress& progress, const Film& film) {
  const auto now = std::chrono::steady_clock::now();
  if (now - last_save_ >= kSaveInterval) {
    save(progress, film);
    last_save_ = now;
  }
  return listener_.pass_done(progress, film);
}

void RunState::take_snapshot() {
  const Progress& progress = result_->progress;
  const std::string path = file(fmt::format("{:06}.exr", progress.passes));
  ExrFile picture = make_exr(scene_, config_, progress, result_->film, false);
  std::erase_if(picture.layers,
                [](const Layer& layer) { return !layer.name.empty() && layer.name != "variance"; });
  write_exr(path, picture);
  snapshots_.push_back({progress.passes, progress.seconds, cpu_before_, path});
}

bool RunState::render_to(int passes) {
  config_.stop = {};
  config_.stop.passes = passes;
  last_save_ = std::chrono::steady_clock::now();
  cpu_start_ = cpu_now();
  result_ = render(scene_, config_, *this, std::move(result_));
  cpu_before_ = cpu_seconds();
  cpu_start_ = cpu_now();
  const bool reached = result_->progress.passes >= passes;
  if (reached) take_snapshot();
  save(result_->progress, result_->film);
  return reached && !result_->interrupted;
}

Run RunState::run() const {
  Run run{config_.seed, snapshots_, result_ && result_->interrupted, 0};
  if (result_) run.non_finite = result_->film.non_finite() + result_->progress.rejected_photons;
  return run;
}

std::string slug(const std::string& name) {
  std::string text;
  for (const char c : name) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (plain) text += c;
    if (!plain && !text.empty() && text.back() != '-') text += '-';
  }
  return text;
}

}  // namespace

double time_of(const Snapshot& snapshot, Clock clock) {
  return clock == Clock::wall ? snapshot.seconds : snapshot.cpu_seconds;
}

bool goes_on(const std::vector<Snapshot>& snapshots, const RunLimit& limit) {
  if (snapshots.empty()) return true;
  const Snapshot& last = snapshots.back();
  return 2 * last.passes <= limit.passes &&
         2 * time_of(last, limit.clock) <= kTimeSlack * limit.seconds;
}

std::string run_folder(const std::string& folder, const Scene& scene, const Variant& variant,
                       std::uint64_t seed) {
  RenderConfig config = variant.config;
  config.seed = seed;
  const std::uint64_t hash = hash_bytes(0, provenance(scene, config));
  return (fs::path(folder) / fmt::format("{}-{}-{:08x}", slug(variant.name), seed, hash >> 32))
      .string();
}

Run continue_run(const std::string& run_folder, const Scene& scene, RenderConfig config,
                 const RunLimit& limit, RenderObserver& observer) {
  RunState state(run_folder, scene, config, observer);
  while (goes_on(state.snapshots(), limit)) {
    if (!state.render_to(state.next())) break;
  }
  return state.run();
}

}  // namespace octolux

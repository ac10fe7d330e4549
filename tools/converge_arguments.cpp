// converge_arguments.h.
#include "tools/converge_arguments.h"

#include "core/error.h"
#include "tools/settings.h"

namespace octolux {
namespace {

double parse_positive(const std::string& option, const std::string& text) {
  const std::string source = option + " " + text;
  const double value = parse_number(source, text);
  if (!(value > 0)) throw Error(source + ": expected a number above 0");
  return value;
}

}  // namespace

void ConvergeArguments::add_to(CLI::App& verb) {
  add_choices(verb);
  add_reference(verb);
}

void ConvergeArguments::add_choices(CLI::App& verb) {
  verb.add_option("--integrator", choices_.integrators, "Integrators (photon path)")
      ->type_name("NAME");
  verb.add_option("--kernel", choices_.kernels,
                  "Kernels (cone octobox feeler); as published: cone:published")
      ->type_name("NAME");
  verb.add_option("--photons", photons_, "Photon paths per pass; several are raced")
      ->type_name("N");
  verb.add_option("--gather", choices_.gathers, "Final gathering: on, off, or both")
      ->type_name("on|off");
  verb.add_option("--seeds", seeds_, "Independent renders of each; their spread gives the bars")
      ->type_name("N")
      ->capture_default_str();
  verb.add_option("--time", time_, "Go on doubling while a render ends within this time")
      ->type_name("SECONDS")
      ->capture_default_str();
  verb.add_option("--passes", passes_, "At most N passes each")->type_name("N");
  verb.add_option("--clock", clock_,
                  "wall: real time; cpu: of all threads together, for busy machines")
      ->type_name("wall|cpu")
      ->capture_default_str();
  verb.add_option("--add", added_, "Another renderer's pictures, with the time each took")
      ->type_name("NAME=TIME:FILE.exr,...")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void ConvergeArguments::add_reference(CLI::App& verb) {
  verb.add_option("--reference", reference_.file,
                  "The truth; larger by a whole number is averaged down (default: path traced)")
      ->type_name("FILE.exr");
  verb.add_option("--references", reference_.folder, "Where path traced references are kept")
      ->type_name("FOLDER")
      ->capture_default_str();
  verb.add_option("--reference-error", reference_error_,
                  "Path trace it to this mean relative standard error")
      ->type_name("E")
      ->capture_default_str();
  verb.add_option("--reference-time", reference_time_, "... or for so long")
      ->type_name("SECONDS")
      ->capture_default_str();
}

ConvergeJob ConvergeArguments::job(const RenderConfig& base) const {
  ConvergeJob job;
  VariantChoices choices = choices_;
  for (const std::string& text : photons_) {
    choices.photons.push_back(parse_int("--photons " + text, text, 1, 2'000'000'000));
  }
  job.variants = make_variants(choices, base);
  for (const std::string& text : added_) job.externals.push_back(parse_external(text));
  job.seeds = parse_int("--seeds " + seeds_, seeds_, 1, 1000);
  job.limit.seconds = parse_positive("--time", time_);
  if (!passes_.empty()) job.limit.passes = parse_int("--passes " + passes_, passes_, 1, 1 << 24);
  if (clock_ != "wall" && clock_ != "cpu") {
    throw Error(unknown_name("clock", clock_, {"wall", "cpu"}));
  }
  job.limit.clock = clock_ == "wall" ? Clock::wall : Clock::cpu;
  job.reference = reference_;
  job.reference.error = parse_positive("--reference-error", reference_error_);
  job.reference.seconds = parse_positive("--reference-time", reference_time_);
  return job;
}

}  // namespace octolux

// What `octolux converge` races, against what and for how long, as arguments.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "tools/converge/external.h"
#include "tools/converge/run.h"
#include "tools/converge/variant.h"
#include "tools/reference/reference.h"

namespace octolux {

/// What is to be done, checked.
struct ConvergeJob {
  std::vector<Variant> variants;
  std::vector<External> externals;
  RunLimit limit;
  int seeds = 0;
  ReferenceOptions reference;
};

class ConvergeArguments {
 public:
  /// The arguments write into this object, so it must stay where it is.
  void add_to(CLI::App& verb);
  /// Throws Error if an argument is malformed. `base`: the settings all variants share.
  ConvergeJob job(const RenderConfig& base) const;

 private:
  void add_choices(CLI::App& verb);
  void add_reference(CLI::App& verb);

  VariantChoices choices_;
  std::vector<std::string> photons_, added_;
  std::string seeds_ = "4", time_ = "10", passes_, clock_ = "wall";
  std::string reference_error_ = "0.005", reference_time_ = "600";
  ReferenceOptions reference_;
};

}  // namespace octolux

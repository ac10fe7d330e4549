// Tables and plots of laboratory results.
#pragma once

#include <string>
#include <vector>

#include "tools/lab/measure.h"

namespace octolux {

/// Results of one case.
struct LabTable {
  std::string title;  // case with its distance and size
  std::vector<LabResult> results;
};

std::string to_csv(const std::vector<LabTable>& tables);
std::string to_json(const std::vector<LabTable>& tables);
/// For reading: one block per case, aligned columns.
std::string to_text(const std::vector<LabTable>& tables);

enum class PlotAxis { neighbours, angle };
/// Bias [%] against photons (logarithmic) or against the wall's angle, one panel per case and one
/// line per kernel, with bars of two standard errors. Colours by Okabe & Ito (2008), for all kinds
/// of colour vision; markers differ too.
std::string to_svg(const std::vector<LabTable>& tables, PlotAxis axis);

}  // namespace octolux

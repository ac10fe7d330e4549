// Laboratory results as text, CSV and JSON.
#include "tools/lab/report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace octolux {

std::string to_csv(const std::vector<LabTable>& tables) {
  std::string text =
      "case,kernel,neighbours,angle,runs,mean,bias,standard_error,deviation,rmse,ns_per_query\n";
  for (const LabTable& table : tables) {
    for (const LabResult& r : table.results) {
      const std::string angle = r.angle < 0 ? "any" : fmt::format("{:g}", r.angle);
      text += fmt::format("{},{},{},{},{},{:.6g},{:.6g},{:.3g},{:.6g},{:.6g},{:.0f}\n", table.title,
                          r.kernel, r.neighbours, angle, r.runs, r.mean, r.bias(), r.standard_error,
                          r.deviation, r.rmse(), r.nanoseconds);
    }
  }
  return text;
}

std::string to_json(const std::vector<LabTable>& tables) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const LabTable& table : tables) {
    for (const LabResult& r : table.results) {
      nlohmann::ordered_json row;
      row["case"] = table.title;
      row["kernel"] = r.kernel;
      row["neighbours"] = r.neighbours;
      row["angle"] = r.angle < 0 ? nlohmann::ordered_json("any") : nlohmann::ordered_json(r.angle);
      row["runs"] = r.runs;
      row["mean"] = r.mean;
      row["bias"] = r.bias();
      row["standard_error"] = r.standard_error;
      row["deviation"] = r.deviation;
      row["rmse"] = r.rmse();
      row["ns_per_query"] = r.nanoseconds;
      all.push_back(row);
    }
  }
  return all.dump(2) + "\n";
}

std::string to_text(const std::vector<LabTable>& tables) {
  std::string text;
  for (const LabTable& table : tables) {
    text += fmt::format("{}\n  {:<26}{:>6}{:>8}{:>11}{:>8}{:>9}{:>8}{:>10}\n", table.title,
                        "kernel", "n", "angle", "bias %", "+-", "noise %", "rmse %", "ns/query");
    for (const LabResult& r : table.results) {
      const std::string angle = r.angle < 0 ? "any" : fmt::format("{:g}", r.angle);
      const std::string time = r.nanoseconds > 0 ? fmt::format("{:.0f}", r.nanoseconds) : "-";
      text += fmt::format("  {:<26}{:>6}{:>8}{:>+11.2f}{:>8.2f}{:>9.2f}{:>8.2f}{:>10}\n", r.kernel,
                          r.neighbours, angle, 100 * r.bias(), 100 * r.standard_error,
                          100 * r.deviation, 100 * r.rmse(), time);
    }
  }
  return text;
}

}  // namespace octolux

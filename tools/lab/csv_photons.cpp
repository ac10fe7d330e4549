// Reading CSV files of numbers.
#include "tools/lab/csv_photons.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>

#include "core/error.h"

namespace octolux {
namespace {

const std::vector<std::string> kColumns = {"x",  "y",  "z",  "nx", "ny", "nz",
                                           "wx", "wy", "wz", "r",  "g",  "b"};
constexpr std::size_t kQueryColumns = 6;
using Row = std::array<float, 12>;

std::vector<std::string> split_line(const std::string& line) {
  std::vector<std::string> fields(1);
  for (const char c : line) {
    if (c == ',') {
      fields.emplace_back();
    } else if (c != ' ' && c != '\t' && c != '\r') {
      fields.back() += c;
    }
  }
  return fields;
}

/// Place in kColumns of each field of the header.
std::vector<std::size_t> read_header(const std::vector<std::string>& fields, std::size_t required,
                                     const std::string& where) {
  std::vector<std::size_t> places;
  for (const std::string& name : fields) {
    const auto found = std::find(kColumns.begin(), kColumns.end(), name);
    if (found == kColumns.end()) {
      throw Error(where + ": " + unknown_name("column", name, kColumns));
    }
    places.push_back(static_cast<std::size_t>(found - kColumns.begin()));
  }
  for (std::size_t i = 0; i < required; ++i) {
    const auto count = std::count(places.begin(), places.end(), i);
    if (count != 1) {
      throw Error(fmt::format("{}: column '{}' must be there once, not {} times", where,
                              kColumns[i], count));
    }
  }
  return places;
}

Row read_row(const std::vector<std::string>& fields, const std::vector<std::size_t>& places,
             const std::string& where) {
  if (fields.size() != places.size()) {
    throw Error(fmt::format("{}: {} values, the header has {} columns", where, fields.size(),
                            places.size()));
  }
  Row row{};
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const char* end = fields[i].data() + fields[i].size();
    const auto [stop, code] = std::from_chars(fields[i].data(), end, row[places[i]]);
    if (code != std::errc() || stop != end) {
      throw Error(fmt::format("{}: expected a number for '{}', not '{}'", where,
                              kColumns[places[i]], fields[i]));
    }
  }
  return row;
}

Vec3 unit(Vec3 v, const char* what, const std::string& where) {
  const float size = length(v);
  if (!(size > 0) || !is_finite(v)) throw Error(where + ": " + what + " has no direction");
  return v / size;
}

/// Calls use(row, where) for each line of numbers.
template <class Use>
void read_rows(const std::string& file, std::size_t required, Use&& use) {
  std::ifstream in(file);
  if (!in) throw Error(file + ": cannot be read");
  std::vector<std::size_t> places;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    const std::string where = fmt::format("{}:{}", file, number);
    if (line.find_first_not_of(" \t\r") == std::string::npos || line[0] == '#') continue;
    const std::vector<std::string> fields = split_line(line);
    if (places.empty()) {
      places = read_header(fields, required, where);
    } else {
      use(read_row(fields, places, where), where);
    }
  }
  if (places.empty()) throw Error(file + ": no header line with the names of the columns");
}

}  // namespace

std::vector<Photon> read_photon_csv(const std::string& file) {
  std::vector<Photon> photons;
  read_rows(file, kColumns.size(), [&](const Row& v, const std::string& where) {
    Photon p;
    p.position = {v[0], v[1], v[2]};
    p.normal = unit({v[3], v[4], v[5]}, "the normal", where);
    p.wi = unit({v[6], v[7], v[8]}, "w", where);
    p.flux = {v[9], v[10], v[11]};
    photons.push_back(p);
  });
  return photons;
}

std::vector<LabPoint> read_query_csv(const std::string& file) {
  std::vector<LabPoint> queries;
  read_rows(file, kQueryColumns, [&](const Row& v, const std::string& where) {
    queries.push_back({{v[0], v[1], v[2]}, unit({v[3], v[4], v[5]}, "the normal", where)});
  });
  return queries;
}

}  // namespace octolux

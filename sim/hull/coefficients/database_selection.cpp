// What is taken of a database that holds more (database_frame.h).
#include <algorithm>
#include <sstream>

#include "sim/hull/coefficients/database_frame.h"
#include "sim/specification.h"

namespace stillhook {

std::vector<int> chosen_bodies(int held, const DatabaseFrame& frame, const std::string& source,
                               std::vector<std::string>& remarks) {
  const int wanted = static_cast<int>(frame.bodies.size());
  std::vector<int> bodies;
  std::ostringstream sentence;
  if (frame.chosen == 0) {
    for (int n = 0; n < held; ++n) bodies.push_back(n);
    if (held == wanted) return bodies;
    sentence << "holds " << held << (held == 1 ? " body" : " bodies") << ", it is read for " << wanted;
    if (wanted == 1) sentence << ": say which with database_body = 1 to " << held;
    throw SpecificationError(source, "", sentence.str());
  }
  if (wanted != 1) throw SpecificationError(source, "", "one body of a database is read for one hull");
  if (frame.chosen > held) {
    sentence << "holds " << held << (held == 1 ? " body" : " bodies")
             << ", there is no database_body = " << frame.chosen;
    throw SpecificationError(source, "", sentence.str());
  }
  if (held > 1) {
    sentence << source << ": body " << frame.chosen << " of " << held
             << " is read; the waves that the others make when they move are left out";
    remarks.push_back(sentence.str());
  }
  return {frame.chosen - 1};
}

void cut_frequencies(HydrodynamicCoefficients& c, const DatabaseFrame& frame, const std::string& source) {
  const auto outside = [&](double w) { return w < frame.lowest || w > frame.highest; };
  const std::size_t before = c.frequency.size() + c.excitation.frequencies.size();
  const bool table = !c.frequency.empty();
  std::erase_if(c.frequency, [&](const FrequencyCoefficients& f) { return outside(f.frequency); });
  ExcitationTable& X = c.excitation;
  ExcitationTable kept{{}, X.headings, X.modes, {}};
  const std::size_t row = X.headings.size() * static_cast<std::size_t>(X.modes);
  for (std::size_t f = 0; f < X.frequencies.size(); ++f) {
    if (outside(X.frequencies[f])) continue;
    kept.frequencies.push_back(X.frequencies[f]);
    const auto from = X.value.begin() + static_cast<std::ptrdiff_t>(f * row);
    kept.value.insert(kept.value.end(), from, from + static_cast<std::ptrdiff_t>(row));
  }
  if (c.frequency.size() + kept.frequencies.size() == before) return;
  // Retardation functions need three of B, and excitation two to look up what lies between.
  const auto moving = std::ranges::count_if(c.frequency, [](const auto& f) { return f.frequency > 0.0; });
  if ((table && moving < 3) || (kept.frequencies.size() < 2 && kept.frequencies.size() < X.frequencies.size())) {
    std::ostringstream sentence;
    sentence << "has fewer than three frequencies from database_lowest_rad_per_s to database_highest_rad_per_s ("
             << frame.lowest << " to " << frame.highest << " rad/s)";
    throw SpecificationError(source, "", sentence.str());
  }
  X = std::move(kept);
  if (table) c.retardation = {};  // computed anew from the B that is left
}

}  // namespace stillhook

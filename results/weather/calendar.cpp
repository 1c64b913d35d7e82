#include "results/weather/calendar.h"

#include <fmt/core.h>

#include <array>
#include <charconv>
#include <chrono>

namespace stillhook {
namespace {

/// Takes a text from its front, piece by piece; good() tells whether all of them were there.
class Pieces {
 public:
  explicit Pieces(std::string_view text) : rest_(text) {}

  bool good() const { return good_; }
  bool at_end() const { return rest_.empty(); }
  bool next_is(char c) const { return !rest_.empty() && rest_.front() == c; }
  /// A character, if it comes next.
  bool take(char c) {
    if (!next_is(c)) return false;
    rest_.remove_prefix(1);
    return true;
  }
  void want(char c) { good_ = take(c) && good_; }
  /// A number of exactly so many digits within bounds.
  int number(std::size_t digits, int low, int high) {
    int value = low;
    if (rest_.size() < digits) return good_ = false, value;
    const char* end = rest_.data() + digits;
    const auto [read, error] = std::from_chars(rest_.data(), end, value);
    good_ = good_ && error == std::errc() && read == end && value >= low && value <= high && rest_.front() != '-';
    rest_.remove_prefix(digits);
    return value;
  }
  void skip_digits() {
    while (!rest_.empty() && rest_.front() >= '0' && rest_.front() <= '9') rest_.remove_prefix(1);
  }

 private:
  std::string_view rest_;
  bool good_ = true;
};

/// Seconds after midnight, local to the zone.
int time_of_day(Pieces& text) {
  const int hour = text.number(2, 0, 23);
  text.want(':');
  const int minute = text.number(2, 0, 59);
  int second = 0;
  if (text.take(':')) {
    second = text.number(2, 0, 59);
    if (text.take('.')) text.skip_digits();
  }
  return 3600 * hour + 60 * minute + second;
}

/// Seconds that the zone is ahead of UTC.
int zone(Pieces& text) {
  if (text.take('Z') || text.at_end()) return 0;
  const bool ahead = text.next_is('+');
  if (!ahead && !text.next_is('-')) return text.want('Z'), 0;
  text.take(ahead ? '+' : '-');
  const int hours = text.number(2, 0, 14);
  text.take(':');
  const int offset = 3600 * hours + 60 * (text.at_end() ? 0 : text.number(2, 0, 59));
  return ahead ? offset : -offset;
}

}  // namespace

CalendarDate date_of(UnixTime instant) {
  using namespace std::chrono;
  const sys_seconds point{seconds(instant)};
  const sys_days day = floor<days>(point);
  const year_month_day date(day);
  return {static_cast<int>(date.year()), static_cast<int>(static_cast<unsigned>(date.month())),
          static_cast<int>(static_cast<unsigned>(date.day())), static_cast<double>((point - day).count()) / kHour};
}

std::optional<UnixTime> instant_of_date(int year, int month, int day) {
  using namespace std::chrono;
  const year_month_day date{std::chrono::year(year), std::chrono::month(static_cast<unsigned>(month)),
                            std::chrono::day(static_cast<unsigned>(day))};
  if (!date.ok()) return std::nullopt;
  return sys_seconds(sys_days(date)).time_since_epoch().count();
}

std::optional<UnixTime> instant_of(std::string_view text) {
  Pieces pieces(text);
  const int year = pieces.number(4, 0, 9999);
  pieces.want('-');
  const int month = pieces.number(2, 1, 12);
  pieces.want('-');
  const int day = pieces.number(2, 1, 31);
  if (!pieces.good()) return std::nullopt;
  const std::optional<UnixTime> midnight = instant_of_date(year, month, day);
  if (!midnight) return std::nullopt;
  if (pieces.at_end()) return midnight;
  if (!pieces.take('T')) pieces.want(' ');
  const int seconds = time_of_day(pieces), ahead = zone(pieces);
  if (!pieces.good() || !pieces.at_end()) return std::nullopt;
  return *midnight + seconds - ahead;
}

std::string instant_text(UnixTime instant) {
  const CalendarDate d = date_of(instant);
  const long seconds = static_cast<long>(((instant % 86400) + 86400) % 86400);
  std::string text =
      fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}", d.year, d.month, d.day, seconds / 3600, seconds / 60 % 60);
  if (seconds % 60 != 0) text += fmt::format(":{:02}", seconds % 60);
  return text + "Z";
}

const char* month_name(int month) {
  static constexpr std::array<const char*, 12> kNames = {"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                                         "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
  return kNames.at(static_cast<std::size_t>(month - 1));
}

}  // namespace stillhook

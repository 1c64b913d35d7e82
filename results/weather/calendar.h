// Instants of weather records: seconds since 1970-01-01T00:00 UTC, and the calendar that they belong to.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace stillhook {

using UnixTime = std::int64_t;

inline constexpr double kHour = 3600.0;       // s
inline constexpr double kDay = 24.0 * kHour;  // s

struct CalendarDate {
  int year = 1970, month = 1, day = 1;  // month and day from 1
  double hour = 0.0;                    // of the day, UTC
};

/// The calendar date (Gregorian, UTC).
CalendarDate date_of(UnixTime instant);

/// The instant of a date at 00:00 UTC; nothing if there is no such day.
std::optional<UnixTime> instant_of_date(int year, int month, int day);

/// ISO 8601: "2019-01-01", "2019-01-01T03:00Z", "2019-01-01 03:00:00.000", "2019-01-01T03:00+02:00"; without a zone it
/// is UTC. Nothing for another text.
std::optional<UnixTime> instant_of(std::string_view text);

/// "2019-01-01T03:00Z", with seconds if they are not zero.
std::string instant_text(UnixTime instant);

/// "Jan" ... "Dec" of 1 to 12.
const char* month_name(int month);

}  // namespace stillhook

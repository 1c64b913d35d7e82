#include <fmt/format.h>
#include <xlsxwriter.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>

#include "results/export.h"
#include "results/files.h"
#include "results/workbook_check.h"
#include "sim/samples.h"

namespace stillhook {
namespace {

constexpr std::size_t kRows = 1048576, kColumns = 16384;  // of a sheet

/// A workbook being written; every error of the library becomes a FileError under the final name.
class Workbook {
 public:
  Workbook(const std::string& path, std::string shown) : shown_(std::move(shown)) {
    // Row by row to temporary files: a long history is never held as a whole sheet.
    lxw_workbook_options options = {};
    options.constant_memory = LXW_TRUE;
    book_ = workbook_new_opt(path.c_str(), &options);
    if (!book_) throw FileError(shown_ + ": cannot be written: no memory for a workbook");
    heading_ = workbook_add_format(book_);
    format_set_bold(heading_);
    format_set_bottom(heading_, LXW_BORDER_THIN);
    pass_ = shaded(0xE2EFDA);
    fail_ = shaded(0xF8CBAD);
  }
  ~Workbook() {
    if (book_) workbook_close(book_);
  }
  Workbook(const Workbook&) = delete;
  Workbook& operator=(const Workbook&) = delete;

  void close() {
    const lxw_error error = workbook_close(book_);
    book_ = nullptr;
    if (error != LXW_NO_ERROR) throw FileError(shown_ + ": cannot be written: " + lxw_strerror(error));
  }

  lxw_workbook* book() { return book_; }
  lxw_format* heading() { return heading_; }
  lxw_format* verdict(bool pass) { return pass ? pass_ : fail_; }
  const std::string& shown() const { return shown_; }

 private:
  lxw_format* shaded(lxw_color_t colour) {
    lxw_format* format = workbook_add_format(book_);
    format_set_bg_color(format, colour);
    return format;
  }
  std::string shown_;
  lxw_workbook* book_ = nullptr;
  lxw_format *heading_ = nullptr, *pass_ = nullptr, *fail_ = nullptr;
};

/// A sheet filled row by row from the top.
class Sheet {
 public:
  Sheet(Workbook& book, const char* name, const std::vector<std::string>& header) : book_(book) {
    if (header.size() > kColumns)
      throw FileError(fmt::format("{}: {} columns do not fit on a sheet; choose some with --channels", book.shown(),
                                  header.size()));
    sheet_ = workbook_add_worksheet(book.book(), name);
    for (std::size_t c = 0; c < header.size(); ++c)
      worksheet_set_column(sheet_, column(c), column(c),
                           std::max<double>(9.0, 1.1 * static_cast<double>(header[c].size())), nullptr);
    worksheet_freeze_panes(sheet_, 1, 1);
    for (const std::string& title : header) text(title, book.heading());
    next_row();
  }
  void text(const std::string& value, lxw_format* format = nullptr) {
    if (!value.empty()) check(worksheet_write_string(sheet_, row_, column(column_), value.c_str(), format));
    ++column_;
  }
  /// Excel knows neither NaN nor infinity: an empty cell.
  void number(double value) {
    if (std::isfinite(value)) check(worksheet_write_number(sheet_, row_, column(column_), value, nullptr));
    ++column_;
  }
  void next_row() {
    ++row_;
    column_ = 0;
  }

 private:
  static lxw_col_t column(std::size_t c) { return static_cast<lxw_col_t>(c); }
  void check(lxw_error error) {
    if (error != LXW_NO_ERROR) throw FileError(book_.shown() + ": cannot be written: " + lxw_strerror(error));
  }
  Workbook& book_;
  lxw_worksheet* sheet_ = nullptr;
  lxw_row_t row_ = 0;
  std::size_t column_ = 0;
};

void write_history(Workbook& book, const Export& data) {
  if (data.run.time.size() >= kRows)
    throw FileError(fmt::format("{}: {} samples do not fit on a sheet of {} rows; use --csv", book.shown(),
                                data.run.time.size(), kRows));
  std::vector<std::string> header = {"time [s]"};
  std::vector<std::vector<double>> columns;
  for (const std::size_t c : data.channels) {
    header.push_back(data.run.channels[c].name + " [" + data.run.channels[c].unit + "]");
    columns.push_back(samples_of(data.run, c));
  }
  Sheet sheet(book, "history", header);
  for (std::size_t i = 0; i < data.run.time.size(); ++i) {
    sheet.number(data.run.time[i]);
    for (const std::vector<double>& column : columns) sheet.number(column[i]);
    sheet.next_row();
  }
}

constexpr const char* kNoSummary = "the run did not come to its end: there is no summary";

void write_metrics(Workbook& book, const std::optional<Summary>& summary) {
  Sheet sheet(book, "metrics", {"metric", "value", "unit", "time [s]", "phase"});
  if (!summary) return sheet.text(kNoSummary);
  for (const Metric& m : summary->metrics.items) {
    sheet.text(m.name);
    sheet.number(m.value);
    sheet.text(m.unit);
    sheet.number(m.time);
    sheet.text(m.phase);
    sheet.next_row();
  }
}

void write_limits(Workbook& book, const std::optional<Summary>& summary) {
  Sheet sheet(
      book, "limits",
      {"limit", "bound", "limit value", "value", "margin", "unit", "kept", "kind", "time [s]", "phase", "source"});
  if (!summary) return sheet.text(kNoSummary);
  for (const LimitCheck& l : summary->limits) {
    sheet.text(l.metric);
    sheet.text(l.is_max ? "max" : "min");
    for (const double value : {l.limit, l.value, l.margin}) sheet.number(value);
    sheet.text(l.unit);
    sheet.text(l.pass ? "yes" : "no", book.verdict(l.pass));
    sheet.text(l.hard ? "hard" : "soft");
    sheet.number(l.time);
    sheet.text(l.phase);
    sheet.text(l.source);
    sheet.next_row();
  }
}

void write_contacts(Workbook& book, const Trajectory& run) {
  constexpr const char* kRoles[] = {"other", "pickup", "target"};
  Sheet sheet(book, "contacts",
              {"contact", "role", "phase", "start [s]", "end [s]", "approach speed [m/s]", "peak force [N]",
               "impulse [N s]", "x [m]", "y [m]", "z [m]"});
  for (const ContactEvent& event : run.contacts) {
    sheet.text(event.contact);
    sheet.text(kRoles[static_cast<int>(event.role)]);
    sheet.text(event.phase);
    for (const double value : {event.start, event.end, event.approach_speed, event.peak_force, event.impulse,
                               event.place.x(), event.place.y(), event.place.z()})
      sheet.number(value);
    sheet.next_row();
  }
}

}  // namespace

void write_xlsx(const Export& data, const std::string& path) {
  PendingFile pending(path);
  // The library says on its own what it cannot open, in words of its own: better to find out before it does.
  if (const std::ofstream probe(pending.temporary()); !probe)
    throw FileError(fmt::format("{}: cannot be written: {}", path, std::strerror(errno)));
  Workbook book(pending.temporary(), path);
  write_history(book, data);
  write_metrics(book, data.summary);
  write_limits(book, data.summary);
  write_contacts(book, data.run);
  book.close();
  if (const std::string fault = workbook_fault(pending.temporary()); !fault.empty())
    throw FileError(
        fmt::format("{}: cannot be written: {}; is a disk full, this one or that of temporary files?", path, fault));
  pending.commit();
}

}  // namespace stillhook

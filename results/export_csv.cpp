#include <fmt/format.h>
#include <fnmatch.h>

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>

#include "results/export.h"
#include "results/files.h"
#include "sim/samples.h"

namespace stillhook {
namespace {

/// A stream that says why it cannot be written, under the name that the user gave.
class Output {
 public:
  Output(std::FILE* file, std::string name) : file_(file), name_(std::move(name)) {
    if (!file_) fail();
  }
  void write(const fmt::memory_buffer& text) {
    if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) fail();
  }
  void flush() {
    if (std::fflush(file_) != 0) fail();
  }

 private:
  [[noreturn]] void fail() const {
    throw FileError(fmt::format("{}: cannot be written: {}", name_, std::strerror(errno)));
  }
  std::FILE* file_;
  std::string name_;
};

/// A field as RFC 4180 wants it.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

void write_table(const Export& data, Output& out) {
  fmt::memory_buffer line;
  const auto append = [&](std::string_view text) { line.append(text); };
  const auto append_number = [&](double value) { fmt::format_to(std::back_inserter(line), "{}", value); };
  std::vector<std::vector<double>> columns;
  append("time [s]");
  for (const std::size_t c : data.channels) {
    const Channel& channel = data.run.channels[c];
    append("," + field(channel.name + " [" + channel.unit + "]"));
    columns.push_back(samples_of(data.run, c));
  }
  append("\n");
  for (std::size_t i = 0; i < data.run.time.size(); ++i) {
    append_number(data.run.time[i]);
    for (const std::vector<double>& column : columns) {
      append(",");
      if (std::isfinite(column[i])) append_number(column[i]);
    }
    append("\n");
    out.write(line);
    line.clear();
  }
  out.write(line);  // a table without samples is its header
  out.flush();
}

}  // namespace

std::vector<std::size_t> matching_channels(const Trajectory& run, const std::vector<std::string>& patterns) {
  std::vector<bool> wanted(run.channels.size(), patterns.empty());
  for (const std::string& pattern : patterns) {
    bool matched = false;
    for (std::size_t c = 0; c < run.channels.size(); ++c) {
      if (fnmatch(pattern.c_str(), run.channels[c].name.c_str(), 0) != 0) continue;
      wanted[c] = matched = true;
    }
    if (!matched)
      throw std::invalid_argument("no channel of the run matches \"" + pattern + "\"; an example of one is \"" +
                                  (run.channels.empty() ? "" : run.channels.front().name) + "\"");
  }
  std::vector<std::size_t> channels;
  for (std::size_t c = 0; c < wanted.size(); ++c)
    if (wanted[c]) channels.push_back(c);
  return channels;
}

void write_csv(const Export& data, const std::string& path) {
  if (path == "-") {
    Output out(stdout, "standard output");
    return write_table(data, out);
  }
  PendingFile pending(path);
  {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(pending.temporary().c_str(), "w"),
                                                               std::fclose);
    Output out(file.get(), path);
    write_table(data, out);
  }
  pending.commit();
}

}  // namespace stillhook

// CSV as programs write it: what is read, and what is refused with which sentence. The texts are our own, in the
// dialects of spreadsheets in several languages, loggers and instrument programs.
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <string>

#include <sys/stat.h>

#include "problems/case.h"
#include "tests/tuning/measured_file.h"
#include "tuning/measured_table.h"

namespace stillhook {
namespace {

using Catch::Matchers::Contains;
using Values = std::vector<std::vector<double>>;

class Csv {
 public:
  MeasuredTable table(const std::string& text, const std::vector<std::string>& names = {"t", "z"}) const {
    return read_measured_table(folder.write("x.csv", text), names);
  }
  Values values(const std::string& text) const { return table(text).values; }
  std::string fault(const std::string& text, const std::vector<std::string>& names = {"t", "z"}) const {
    try {
      table(text, names);
    } catch (const CaseError& error) {
      return error.what();
    }
    return "no complaint";
  }
  TemporaryFolder folder;
};

const Values kTwoRows = {{0.0, 0.1}, {0.5, -1.25}};

TEST_CASE("dialects of CSV that all say the same", "[csv]") {
  const Csv csv;
  for (const std::string text : {"t,z\n0,0.5\n0.1,-1.25\n",
                                 "\xEF\xBB\xBFt;z\r\n0,0;0,5\r\n0,1;-1,25\r\n",        // Excel's "CSV UTF-8", German
                                 "t\tz\n0,0\t0,5\n0,1\t-1,25\n",                       // tabs, decimal commas
                                 "t z\n0,0 0,5\n0,1 -1,25\n",                          // blanks, decimal commas
                                 "\"t\",\"z\"\n\"0,0\",\"0,5\"\n\"0,1\",\"-1,25\"\n",  // all quoted, decimal commas
                                 "\"t\",\"z\"\n\"0\",\"0.5\"\n\"0.1\",\"-1.25\"\n",    // all quoted, points
                                 "t,\"Heave, m\",z\n0,1,0.5\n0.1,1,-1.25\n",           // a comma in a name
                                 "t,\"says \"\"up\"\"\",z\n0,1,0.5\n0.1,1,-1.25\n",    // quotes in a name
                                 "t,\"two\nlines\",z\n0,1,0.5\n0.1,1,-1.25\n",         // a line break in a name
                                 "sep=;\nt;z\n0;0.5\n0.1;-1.25\n",                     // Excel's own remark
                                 "t;z;\n0;0.5;\n0.1;-1.25;\n",                         // a separator ends each row
                                 "t;z\n0;0.5;\n0.1;-1.25;;\n",                         // only rows of numbers
                                 "t,z\rs,m\r0,0.5\r0.1,-1.25\r",                       // line ends of an old Macintosh
                                 "# note\n\n  t , z \n 0 , +5e-1 \n\n0.1,-1.25",       // blanks, no last line end
                                 "t;z\n[s];[m]\n0,0;0,5\n0,1;-1,25\n",                 // a line of units
                                 "t,z\ns,1\n0,0.5\n0.1,-1.25\n",                       // with a pure number
                                 "z;t\nm;s\n0,5;0,0\n-1,25;0,1\n",                     // in another order
                                 "t\tz\n0,0E+00\t5,0E-01\n1,0E-01\t-1,25E+00\n"}) {
    CAPTURE(text);
    CHECK(csv.values(text) == kTwoRows);
  }
}

TEST_CASE("a row says where it stands in the file, quoted line breaks and comments counted", "[csv]") {
  const Csv csv;
  const MeasuredTable table = csv.table("# a\nt,\"b\nc\",z\ns,-,m\n1,2,3\n\n# d\n2,2,4\n");
  CHECK(table.place(0).ends_with("x.csv:5"));
  CHECK(table.place(1).ends_with("x.csv:8"));
}

TEST_CASE("cells that say that there is nothing are gaps", "[csv]") {
  const Csv csv;
  for (const std::string cell : {"", "NaN", "nan", "-NaN", "NA", "N/A", "#N/A", "null", "None", "-", "--", "inf",
                                 "-Inf", "Infinity", "1.#QNAN", "-1.#IND", "\"\"", "missing"}) {
    CAPTURE(cell);
    const Values values = csv.values("t,z\n0,1.5\n1," + cell + "\n2,2.5\n");
    CHECK(std::isnan(values[1][1]));
    CHECK(values[1][2] == 2.5);
  }
}

TEST_CASE("one line of units is passed over, never a row of numbers", "[csv]") {
  const Csv csv;
  CHECK_THAT(csv.fault("t,z\ns,m\ns,m\n0,1\n"), Contains("x.csv:3: column \"t\": is no number: \"s\""));
  // All these looked like a line of units once and vanished without a word.
  CHECK_THAT(csv.fault("t,z\n0,bad\n1,2\n"), Contains("x.csv:2: column \"z\": is no number: \"bad\""));
  CHECK_THAT(csv.fault("t,z\n0;10,1\n1,2\n"), Contains("is no number: \"0;10\""));
  CHECK_THAT(csv.fault("t,z\n2024-05-01 10:00,1\n"), Contains("is no number: \"2024-05-01 10:00\""));
  CHECK_THAT(csv.fault("t,z\n00:00:01,1\n"), Contains("is no number: \"00:00:01\""));
  CHECK_THAT(csv.fault("t,z\n0.1 s,1\n"), Contains("is no number: \"0.1 s\""));
  CHECK(csv.table("t,z\ns,m\n").rows() == 0);
}

TEST_CASE("commas that may mean two things are not guessed", "[csv]") {
  const Csv csv;
  CHECK_THAT(csv.fault("t;z\n0.5;1,5\n1.0;2,5\n"),
             Contains("x.csv:2: has a number with a comma, \"1,5\", and in line 2 one with a point, \"0.5\""));
  CHECK_THAT(csv.fault("t,z\n0,\"1,234\"\n1,\"2,345\"\n"), Contains("\"1,234\" may have a decimal comma"));
  CHECK_THAT(csv.fault("t,z\n0,\"1,234.5\"\n"), Contains("is no number: \"1,234.5\""));
  CHECK_THAT(csv.fault("t;z\n0;1.234,5\n"), Contains("is no number: \"1.234,5\""));
  CHECK_THAT(csv.fault("t;z\n0;1,2,3\n"), Contains("is no number: \"1,2,3\""));
  CHECK_THAT(csv.fault("t;z\n0;1,\n"), Contains("is no number: \"1,\""));
  // Commas between the cells and in the numbers: more cells than names.
  CHECK_THAT(csv.fault("t,z\n0,0,0,5\n"),
             Contains("x.csv:2: has 4 cells, the names say 2; numbers with decimal commas"));
  CHECK(csv.values("t;z\n0;1,234\n1;2,345\n")[1][0] == 1.234);  // between semicolons the comma is the decimal one
}

TEST_CASE("numbers that are none", "[csv]") {
  const Csv csv;
  for (const std::string cell : {"1e999", "1.0D-03", "0x10", "+-5", "--5", "1 234", "5%", "1.2.3", "on", "e5", "."}) {
    CAPTURE(cell);
    CHECK_THAT(csv.fault("t,z\n0,1\n1," + cell + "\n"),
               Contains("x.csv:3: column \"z\": is no number: \"" + cell + "\""));
  }
}

TEST_CASE("names and rows that do not fit", "[csv]") {
  const Csv csv;
  CHECK_THAT(csv.fault("t,z,z\n0,1,2\n"), Contains("x.csv:1: has two columns \"z\", number 2 and 3; rename one"));
  CHECK_THAT(csv.fault("t,Z\n0,1\n"), Contains("has no column \"z\", did you mean \"Z\"?"));
  CHECK_THAT(csv.fault("Serial 4711\nt,z\n0,1\n"), Contains("Lines above it must begin with #"));
  CHECK_THAT(csv.fault("t,z\n0\n"), Contains("x.csv:2: has 1 cells, the names say 2"));
  CHECK_THAT(csv.fault("t,z\n0,1,7\n"), Contains("x.csv:2: has 3 cells, the names say 2"));
  CHECK_THAT(csv.fault("t,z\n0,\"1\n1,2\n"), Contains("is not closed"));
  CHECK_THAT(csv.fault("t,z\n0,\"1\"5\n"), Contains("text follows the closing quote"));
  CHECK_THAT(csv.fault("0;0,5\n0,1;1\n"), Contains("numbers begin at once"));
  CHECK_THAT(csv.fault("# only a remark\n"), Contains("has no line with the names"));
  // Two channels may be taken from one column.
  CHECK(csv.table("t,z\n0,5\n1,6\n", {"t", "z", "z"}).values[2] == std::vector<double>{5.0, 6.0});
}

TEST_CASE("files that are no CSV are told what they are", "[csv]") {
  const Csv csv;
  CHECK_THAT(csv.fault(std::string("\xFF\xFEt\0,\0z\0\n\0", 10)), Contains("UTF-16") && Contains("CSV UTF-8"));
  CHECK_THAT(csv.fault("PK\x03\x04rest"), Contains("workbook"));
  CHECK_THAT(csv.fault("\x1F\x8B\x08"), Contains("gzip"));
  CHECK_THAT(csv.fault("MATLAB 5.0 MAT-file"), Contains("MATLAB"));
  CHECK_THAT(csv.fault(std::string("t,z\n0,\0\n", 8)), Contains("binary"));
  CHECK_THAT(csv.fault(""), Contains("has no line with the names"));
}

TEST_CASE("what is no file is refused as what it is", "[csv]") {
  const Csv csv;
  const auto fault = [](const std::string& path) {
    try {
      read_measured_table(path, {"t"});
    } catch (const CaseError& error) {
      return std::string(error.what());
    }
    return std::string("no complaint");
  };
  const std::string pipe = csv.folder / "pipe.csv";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  CHECK_THAT(fault(pipe), Contains("pipe.csv: cannot be read: is a pipe"));  // and does not wait for somebody to write
  CHECK_THAT(fault("/dev/null"), Contains("is a pipe or a device"));
  CHECK_THAT(fault(csv.folder / "."), Contains("is a folder"));
  CHECK_THAT(fault(csv.folder / "none.csv"), Contains("there is no such file"));
}

}  // namespace
}  // namespace stillhook

// What a controlled document says of itself, and the hash that names its case.
#include "results/document_control.h"

#include <catch2/catch.hpp>

#include "results/sha256.h"

using namespace stillhook;

TEST_CASE("SHA-256 as in the examples of FIPS 180 and NIST's vectors") {
  CHECK(sha256("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  CHECK(sha256("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  // Two blocks: the padding does not fit into the first.
  CHECK(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq") ==
        "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  CHECK(sha256(std::string(1000000, 'a')) == "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST_CASE("a document without names shows date, case and program; with one it shows where the others are missing") {
  DocumentControl control;
  control.date = "2026-03-01 14:05 UTC";
  control.case_hash = sha256("abc");
  const std::string plain = control_html(control, "1.2.3");
  CHECK(plain.find("Revision") == std::string::npos);
  for (const char* part : {"<dd>2026-03-01 14:05 UTC</dd>", "ba7816bf8f01…", "<dd>stillhook 1.2.3</dd>"})
    CHECK_THAT(plain, Catch::Contains(part));
  control.author = "A. <Naval> Architect";
  const std::string named = control_html(control, "1.2.3");
  CHECK_THAT(named, Catch::Contains("<dt>Author</dt><dd>A. &lt;Naval&gt; Architect</dd>"));
  CHECK_THAT(named, Catch::Contains("<dt>Checked by</dt><dd>–</dd>"));
}

TEST_CASE("the margins of printed pages hold title, revision, date, people, case, program and the page's number") {
  const DocumentControl control{"Topside", "B", "Ann", "", "2026-03-01 14:05 UTC", sha256("abc")};
  const std::string css = control_style(control, "A \"quoted\" </style> title", "1.2.3");
  CHECK_THAT(css,
             Catch::Contains("@top-left{content:\"Topside · A \\000022quoted\\000022 \\00003c/style\\00003e title\""));
  CHECK_THAT(css, Catch::Contains("@top-right{content:\"revision B · 2026-03-01 14:05 UTC\""));
  CHECK_THAT(css, Catch::Contains("author Ann · checked by – · case.toml SHA-256 ba7816bf8f01… · stillhook 1.2.3\""));
  CHECK_THAT(css, Catch::Contains("counter(page) \" of \" counter(pages)"));
  CHECK(css.find('<') == std::string::npos);  // the text of a case cannot end the style element
}

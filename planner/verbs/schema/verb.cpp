#include <fmt/format.h>

#include "planner/verbs/verbs.h"
#include "problems/schema.h"
#include "results/metrics_reference.h"

namespace stillhook {
namespace {

class SchemaVerb final : public Verb {
 public:
  std::string name() const override { return "schema"; }
  std::string help() const override { return "Print the JSON Schema of case files"; }
  void add_options(VerbOptions& o) override {
    o.add({"--reference", &reference_, "", "Print the key reference (Markdown) instead"});
    o.add({"--metrics", &metrics_, "", "Print the list of metrics (Markdown) instead"});
  }
  int run(const CommonOptions&) override {
    if (reference_ && metrics_) throw UsageError("schema: say --reference or --metrics");
    fmt::print("{}", reference_ ? key_reference_markdown()
                     : metrics_ ? metric_reference_markdown()
                                : json_schema() + "\n");
    return kDone;
  }

 private:
  bool reference_ = false, metrics_ = false;
};

}  // namespace

std::unique_ptr<Verb> schema_verb() { return std::make_unique<SchemaVerb>(); }

}  // namespace stillhook

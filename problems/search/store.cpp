#include "problems/search/store.h"

#include <sqlite3.h>

#include <chrono>
#include <cstring>
#include <mutex>
#include <nlohmann/json.hpp>
#include <vector>

namespace stillhook {
namespace {

constexpr const char* kSchemaVersion = "2";

constexpr const char* kTables =
    "CREATE TABLE IF NOT EXISTS meta (key TEXT PRIMARY KEY, value TEXT NOT NULL);"
    "CREATE TABLE IF NOT EXISTS evaluation ("
    "  id INTEGER PRIMARY KEY AUTOINCREMENT,"  // the order in which they were finished
    "  x BLOB NOT NULL,"                       // blobs: arrays of doubles, exact bits, in this machine's byte order
    "  with_gradient INTEGER NOT NULL,"        // asked for; whether it is valid is another matter
    "  usable INTEGER NOT NULL, objective REAL NOT NULL, violation REAL NOT NULL, constraints BLOB NOT NULL,"
    "  details BLOB NOT NULL, message TEXT NOT NULL, gradient_valid INTEGER NOT NULL, objective_gradient BLOB,"
    "  constraint_jacobian BLOB, source TEXT NOT NULL, wall_s REAL NOT NULL, finished_at TEXT NOT NULL,"
    "  UNIQUE (x, with_gradient));";

// -0 and 0 are one number with two bit patterns.
Eigen::VectorXd canonical(const Eigen::VectorXd& x) { return x.array() + 0.0; }

/// One prepared statement, reset when it goes out of use.
class Statement {
 public:
  Statement(sqlite3* db, const std::string& path, const char* sql) : db_(db), path_(path) {
    check(sqlite3_prepare_v2(db, sql, -1, &statement_, nullptr));
  }
  ~Statement() { sqlite3_finalize(statement_); }
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  void bind(int i, const double* data, Eigen::Index count) {
    // A null pointer would bind NULL instead of an empty blob.
    static constexpr double kNothing = 0.0;
    check(sqlite3_bind_blob64(statement_, i, count ? data : &kNothing, sizeof(double) * static_cast<std::size_t>(count),
                              SQLITE_TRANSIENT));
  }
  void bind(int i, const Eigen::VectorXd& v) { bind(i, v.data(), v.size()); }
  void bind(int i, const std::string& text) {
    check(sqlite3_bind_text(statement_, i, text.c_str(), static_cast<int>(text.size()), SQLITE_TRANSIENT));
  }
  void bind(int i, double value) { check(sqlite3_bind_double(statement_, i, value)); }
  void bind(int i, bool value) { check(sqlite3_bind_int(statement_, i, value)); }

  /// True while there is a row.
  bool step() {
    const int code = sqlite3_step(statement_);
    if (code != SQLITE_ROW && code != SQLITE_DONE) check(code);
    return code == SQLITE_ROW;
  }
  std::string text(int column) const {
    const auto* p = reinterpret_cast<const char*>(sqlite3_column_text(statement_, column));
    return p ? std::string(p, static_cast<std::size_t>(sqlite3_column_bytes(statement_, column))) : std::string();
  }
  double number(int column) const { return sqlite3_column_double(statement_, column); }
  bool flag(int column) const { return sqlite3_column_int(statement_, column) != 0; }
  std::vector<double> numbers(int column) const {
    const void* p = sqlite3_column_blob(statement_, column);
    std::vector<double> out(static_cast<std::size_t>(sqlite3_column_bytes(statement_, column)) / sizeof(double));
    if (!out.empty()) std::memcpy(out.data(), p, out.size() * sizeof(double));
    return out;
  }

 private:
  void check(int code) const {
    if (code != SQLITE_OK) throw StoreError(path_ + ": " + sqlite3_errmsg(db_));
  }
  sqlite3* db_;
  const std::string& path_;
  sqlite3_stmt* statement_ = nullptr;
};

Eigen::VectorXd to_vector(const std::vector<double>& v) {
  return Eigen::Map<const Eigen::VectorXd>(v.data(), static_cast<Eigen::Index>(v.size()));
}

}  // namespace

class EvaluationStore::Database {
 public:
  explicit Database(const std::string& path) : path_(path) {
    const int code = sqlite3_open_v2(path.c_str(), &db_, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, nullptr);
    if (code != SQLITE_OK) {
      const std::string why = db_ ? sqlite3_errmsg(db_) : "out of memory";
      sqlite3_close(db_);
      throw StoreError(path + ": cannot be opened: " + why);
    }
    sqlite3_busy_timeout(db_, 10000);
  }
  ~Database() { sqlite3_close(db_); }
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  std::mutex mutex;

  Statement prepare(const char* sql) { return {db_, path_, sql}; }
  void execute(const char* sql) {
    char* message = nullptr;
    if (sqlite3_exec(db_, sql, nullptr, nullptr, &message) == SQLITE_OK) return;
    const std::string why = message ? message : sqlite3_errmsg(db_);
    sqlite3_free(message);
    throw StoreError(path_ + ": is not a usable evaluation store: " + why);
  }
  std::string meta(const char* key) {
    Statement s = prepare("SELECT value FROM meta WHERE key = ?");
    s.bind(1, std::string(key));
    return s.step() ? s.text(0) : std::string();
  }
  void set_meta(const char* key, const std::string& value) {
    Statement s = prepare("INSERT OR REPLACE INTO meta VALUES (?, ?)");
    s.bind(1, std::string(key));
    s.bind(2, value);
    s.step();
  }

  /// Writes the identity into a new store, or refuses one that has another.
  void claim(const StoreIdentity& identity, const SearchProblem& problem) {
    if (const std::string schema = meta("schema_version"); schema.empty()) {
      set_meta("version", identity.version);
      set_meta("problem", identity.problem);
      set_meta("variables", nlohmann::json(problem.variable_names).dump());
      set_meta("constraints", nlohmann::json(problem.constraint_names).dump());
      set_meta("schema_version", kSchemaVersion);
      return;
    } else if (schema != kSchemaVersion) {
      throw StoreError(path_ + ": was made by another version of stillhook (layout " + schema +
                       ", this one reads layout " + kSchemaVersion + "); start anew with --force or another --out");
    }
    if (const std::string version = meta("version"); version != identity.version)
      throw StoreError(path_ + ": was made by stillhook " + version + ", this is " + identity.version +
                       "; start anew with --force or another --out");
    if (meta("problem") != identity.problem)
      throw StoreError(path_ +
                       ": belongs to another case (the case file, a --set value or a file it names has changed); "
                       "start anew with --force or another --out");
  }

 private:
  std::string path_;
  sqlite3* db_ = nullptr;
};

EvaluationStore::EvaluationStore(const std::string& path, const StoreIdentity& identity, const SearchProblem& problem)
    : db_(std::make_unique<Database>(path)) {
  // FULL: an evaluation takes seconds and a sync milliseconds, so not even a power cut should cost one.
  db_->execute("PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL;");
  db_->execute("BEGIN IMMEDIATE");
  db_->execute(kTables);
  db_->claim(identity, problem);
  db_->execute("COMMIT");
}

EvaluationStore::~EvaluationStore() = default;

std::optional<Evaluation> EvaluationStore::find(const Eigen::VectorXd& x, bool with_gradient) {
  const std::lock_guard lock(db_->mutex);
  Statement s = db_->prepare(
      "SELECT usable, objective, constraints, details, message, gradient_valid, objective_gradient,"
      " constraint_jacobian FROM evaluation WHERE x = ? AND with_gradient = ?");
  s.bind(1, canonical(x));
  s.bind(2, with_gradient);
  if (!s.step()) return std::nullopt;
  Evaluation e;
  e.usable = s.flag(0);
  e.objective = s.number(1);
  e.constraints = to_vector(s.numbers(2));
  e.details = s.numbers(3);
  e.message = s.text(4);
  e.gradient_valid = s.flag(5);
  if (e.gradient_valid) {
    e.objective_gradient = to_vector(s.numbers(6));
    const std::vector<double> jacobian = s.numbers(7);
    e.constraint_jacobian = Eigen::Map<const Eigen::MatrixXd>(jacobian.data(), e.constraints.size(), x.size());
  }
  e.from_store = true;
  return e;
}

void EvaluationStore::insert(const Eigen::VectorXd& x, const Evaluation& e, bool with_gradient,
                             const std::string& source, double wall_s) {
  const std::lock_guard lock(db_->mutex);
  Statement s = db_->prepare(
      "INSERT OR IGNORE INTO evaluation (x, with_gradient, usable, objective, violation, constraints, details, message,"
      " gradient_valid, objective_gradient, constraint_jacobian, source, wall_s, finished_at)"
      " VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, strftime('%Y-%m-%dT%H:%M:%fZ', 'now'))");
  s.bind(1, canonical(x));
  s.bind(2, with_gradient);
  s.bind(3, e.usable);
  s.bind(4, e.objective);
  s.bind(5, e.violation());
  s.bind(6, e.constraints);
  s.bind(7, e.details.data(), static_cast<Eigen::Index>(e.details.size()));
  s.bind(8, e.message);
  s.bind(9, e.gradient_valid);
  if (e.gradient_valid) {
    s.bind(10, e.objective_gradient);
    s.bind(11, e.constraint_jacobian.data(), e.constraint_jacobian.size());
  }
  s.bind(12, source);
  s.bind(13, wall_s);
  s.step();
}

int EvaluationStore::size() {
  const std::lock_guard lock(db_->mutex);
  Statement s = db_->prepare("SELECT count(*) FROM evaluation");
  s.step();
  return static_cast<int>(s.number(0));
}

SearchProblem with_store(const SearchProblem& problem, EvaluationStore& store, const std::string& source) {
  const auto stored = [&](const auto& evaluate, bool with_gradient) {
    return [evaluate, problem, &store, source, with_gradient](const Eigen::VectorXd& x) {
      if (std::optional<Evaluation> known = store.find(x, with_gradient)) return sanitised(std::move(*known), problem);
      const auto begin = std::chrono::steady_clock::now();
      // Sanitised first: what comes back from the store must be what was first handed on, and SQLite has no NaN.
      Evaluation evaluation = sanitised(evaluate(x), problem);
      const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
      if (!evaluation.interrupted) store.insert(x, evaluation, with_gradient, source, wall.count());
      return evaluation;
    };
  };
  SearchProblem result = problem;
  result.evaluate = stored(problem.evaluate, false);
  if (problem.evaluate_with_gradient) result.evaluate_with_gradient = stored(problem.evaluate_with_gradient, true);
  return result;
}

}  // namespace stillhook

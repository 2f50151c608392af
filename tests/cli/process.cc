#include "tests/cli/process.h"

#include <fcntl.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <fstream>
#include <utility>

#include "src/base/core/check.h"

namespace lanelight {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// What starts the program: itself, or what runs programs for another processor here.
#ifdef LANELIGHT_EMULATOR
const std::vector<const char*> kCommand = {LANELIGHT_EMULATOR, LANELIGHT_BINARY};
#else
const std::vector<const char*> kCommand = {LANELIGHT_BINARY};
#endif

struct Pipe {
  std::array<int, 2> ends{-1, -1};
  Pipe() { LL_CHECK_EQ(pipe2(ends.data(), O_CLOEXEC), 0); }
  ~Pipe() {
    for (int end : ends) {
      if (end >= 0) close(end);
    }
  }
  void CloseReader() { close(std::exchange(ends[0], -1)); }
  void CloseWriter() { close(std::exchange(ends[1], -1)); }
};

// In the child, between fork and exec.
void PrepareChild(const ProcessOptions& options, const Pipe& out, const Pipe& err) {
  for (int s : {SIGINT, SIGTERM, SIGPIPE}) signal(s, SIG_DFL);
  int target = out.ends[1];
  if (!options.stdout_path.empty()) target = open(options.stdout_path.c_str(), O_WRONLY);
  dup2(target, STDOUT_FILENO);
  dup2(err.ends[1], STDERR_FILENO);
  if (options.file_size_limit > 0) {
    signal(SIGXFSZ, SIG_IGN);
    const auto bytes = static_cast<rlim_t>(options.file_size_limit);
    const rlimit limit = {bytes, bytes};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  if (!options.temp_directory.empty()) {
    setenv("TMPDIR", options.temp_directory.c_str(), 1);
  }
  unsetenv("COLUMNS");
  if (!options.columns.empty()) setenv("COLUMNS", options.columns.c_str(), 1);
  if (options.prepare) options.prepare();
}

pid_t Start(const std::vector<std::string>& arguments, const ProcessOptions& options,
            const Pipe& out, const Pipe& err) {
  std::vector<const char*> argv = kCommand;
  for (const std::string& a : arguments) argv.push_back(a.c_str());
  argv.push_back(nullptr);
  const pid_t child = fork();
  LL_CHECK_GE(child, 0);
  if (child != 0) return child;
  PrepareChild(options, out, err);
  execv(argv[0], const_cast<char* const*>(argv.data()));
  _exit(127);
}

// Reads what is there; closes the pipe at its end. Returns whether it is still open.
bool Drain(Pipe& pipe, std::string* text) {
  char buffer[4096];
  const ssize_t n = read(pipe.ends[0], buffer, sizeof(buffer));
  if (n > 0) {
    text->append(buffer, static_cast<std::size_t>(n));
    return true;
  }
  pipe.CloseReader();
  return false;
}

void Watch(pid_t child, const ProcessOptions& options, Pipe& out, Pipe& err,
           ProcessResult& result) {
  const auto start = Clock::now();
  bool waiting = static_cast<bool>(options.action);
  while (out.ends[0] >= 0 || err.ends[0] >= 0) {
    pollfd files[2] = {{out.ends[0], POLLIN, 0}, {err.ends[0], POLLIN, 0}};
    poll(files, 2, 20);
    if (files[0].revents) Drain(out, &result.out);
    if (files[1].revents) Drain(err, &result.err);
    if (waiting && result.err.find(options.trigger) != std::string::npos) {
      waiting = false;
      options.action(child);
    }
    const std::chrono::duration<double> waited = Clock::now() - start;
    if (waited.count() > options.timeout) kill(child, SIGKILL);
  }
}

}  // namespace

ProcessResult RunLanelight(const std::vector<std::string>& arguments,
                           const ProcessOptions& options) {
  Pipe out, err;
  ProcessResult result;
  const auto start = Clock::now();
  if (options.close_stdout_reader) out.CloseReader();
  const pid_t child = Start(arguments, options, out, err);
  out.CloseWriter();
  err.CloseWriter();
  Watch(child, options, out, err, result);
  int status = 0;
  LL_CHECK_EQ(waitpid(child, &status, 0), child);
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  result.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  result.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return result;
}

void ForbidLocks() {
  sock_filter code[] = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_fcntl, 0, 3),
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, args[1])),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, F_OFD_SETLK, 0, 1),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | ENOLCK),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
  };
  const sock_fprog program = {sizeof(code) / sizeof(code[0]), code};
  if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) _exit(126);
  if (prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) != 0) _exit(126);
}

TempDirectory::TempDirectory() {
  std::string name = (fs::temp_directory_path() / "lanelight-test-XXXXXX").string();
  LL_CHECK(mkdtemp(name.data()) != nullptr);
  path_ = name;
}

TempDirectory::~TempDirectory() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::vector<std::string> TempDirectory::Files() const {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(path_)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string WriteText(const std::string& path, const std::string& text) {
  std::ofstream(path) << text;
  return path;
}

std::string WriteSphereScene(const TempDirectory& directory) {
  return WriteText(directory / "sphere.pbrt", R"(
LookAt 0 0 -5  0 0 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 32 "integer yresolution" 24
Sampler "independent" "integer pixelsamples" 16
Integrator "path" "integer maxdepth" 4
WorldBegin
LightSource "point" "point3 from" [0 4 -4] "rgb I" [30 30 30]
Material "diffuse" "rgb reflectance" [0.5 0.4 0.3]
Shape "sphere" "float radius" 1
)");
}

}  // namespace lanelight

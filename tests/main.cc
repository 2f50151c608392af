// Catch's main, with a tag for every test case that names its file: `[#shade/stage_test]`
// selects what tests/kernels/shade/stage_test.cc has. Catch's own tags of files have no
// folder, and files of different folders share names.
#define CATCH_CONFIG_RUNNER
#include <malloc.h>

#include <catch2/catch.hpp>
#include <string>
#include <vector>

namespace {

std::string TagOf(const std::string& file) {
  const std::string folder = "tests/";
  const std::size_t begin = file.rfind(folder) + folder.size();
  return "#" + file.substr(begin, file.rfind('.') - begin);
}

// As Catch::applyFilenamesAsTags does it.
void TagByFile(const Catch::IConfig& config) {
  for (const Catch::TestCase& c : Catch::getAllTestCasesSorted(config)) {
    auto& test_case = const_cast<Catch::TestCase&>(c);
    std::vector<std::string> tags = test_case.tags;
    tags.push_back(TagOf(test_case.lineInfo.file));
    Catch::setTags(test_case, tags);
  }
}

}  // namespace

int main(int argc, char** argv) {
  // Memory that a test frees is kept for the next wavefront of columns, so that the
  // system need not clear it again: half the time of tests that make thousands of them.
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
  Catch::Session session;
  const int wrong = session.applyCommandLine(argc, argv);
  if (wrong != 0) return wrong;
  TagByFile(session.config());
  return session.run();
}

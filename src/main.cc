#include "src/cli/app.h"

int main(int argc, char** argv) { return lanelight::RunCommandLine(argc, argv); }

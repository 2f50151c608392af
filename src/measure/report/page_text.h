// The fixed parts of the pages, before and after their data, and the script of plots.
// Their definitions are made from src/measure/report/page/ and python/ by embed_page.py
// when the library is built.
#pragma once

#include <string>

namespace lanelight {

std::string PageHead();  // from the doctype to where the data goes
std::string PageTail();  // the scripts, to the end of the document

std::string PaperPageHead();  // the same of the paper's figures on one page
std::string PaperPageTail();

std::string ComparePageHead();  // the same of the page of comparisons
std::string ComparePageTail();

std::string SweepPageHead();  // the same of a sweep's page
std::string SweepPageTail();

std::string BenchPageHead();  // of `lanelight bench`
std::string BenchPageTail();

std::string StressPageHead();  // and of a run of stress cases
std::string StressPageTail();

std::string LivePageHead();  // and of `lanelight live`
std::string LivePageTail();

std::string PlotScript();  // python/lanelight_plot.py in one piece, for python3 -c

}  // namespace lanelight

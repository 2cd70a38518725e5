#include "sim/report/html/head.h"

#include "sim/report/html/style.h"

namespace assay::report {

Element Head(const std::string& title) {
  Element head("head");
  head.Add("meta").Set("charset", "utf-8");
  head.Add("meta").Set("name", "viewport").Set("content", "width=device-width, initial-scale=1");
  head.Add("meta").Set("name", "color-scheme").Set("content", "light dark");
  head.Add("meta").Set("name", "generator").Set("content", "assay report");
  // The policy forbids the browser to fetch anything.
  head.Add("meta")
      .Set("http-equiv", "Content-Security-Policy")
      .Set("content", "default-src 'none'; style-src 'unsafe-inline'; img-src data:");
  // Without an icon here, a browser would ask a server for one.
  head.Add("link").Set("rel", "icon").Set("href", "data:,");
  head.Add("title", title + " – assay report");
  head.Add("style", StyleSheet());
  return head;
}

}  // namespace assay::report

"""The pages for browsers: their links lead somewhere here, and nothing comes from elsewhere. tests/web opens them."""

import html.parser
import re
import unittest
import zlib

from running_qdot import RunningQdot

PAGES = ("/", "/docs")


class Links(html.parser.HTMLParser):
    """What a page refers to, and what it says in scripts and handlers of its own."""

    def __init__(self, text):
        super().__init__()
        self.targets, self.handlers = [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.targets += [value for name, value in attributes if name in ("href", "src", "action", "srcset", "data")]
        self.handlers += [name for name, _ in attributes if name.startswith("on") or name == "style"]


class Pages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.server = RunningQdot("--threads", "2", "--deadline", "60")
        cls.pages = {path: cls.get(path).data.decode() for path in PAGES}

    @classmethod
    def tearDownClass(cls):
        cls.server.__exit__()

    @classmethod
    def get(cls, path):
        return cls.server.request("GET", path, headers={"Accept": "text/html, */*;q=0.8"})

    def test_every_link_leads_to_a_page_of_this_server(self):
        for page, text in self.pages.items():
            targets = Links(text).targets
            self.assertGreater(len(targets), 1)
            for target in targets:
                if target.startswith("#"):
                    continue
                with self.subTest(page=page, target=target):
                    self.assertRegex(target, "^/(?!/)")
                    self.assertEqual(self.get(target).status, 200)

    def parts(self):
        """Every file that the pages load, and what those load."""
        seen, waiting = {}, [target for text in self.pages.values() for target in Links(text).targets if target.startswith("/page/")]
        while waiting:
            path = waiting.pop()
            if path not in seen:
                seen[path] = self.get(path).data.decode()
                waiting += ["/page/" + name for name in re.findall(r'(?:from|import) "\./([^"]+)"', seen[path])]
        return seen

    def test_nothing_comes_from_elsewhere(self):
        parts = self.parts()
        self.assertGreater(len(parts), 20)
        for path, text in [*self.pages.items(), *parts.items()]:
            with self.subTest(path):
                self.assertNotRegex(text.replace("http://www.w3.org/", ""), r"https?://|@import|\burl\(\s*[\"']?(?!#)")
                self.assertNotRegex(text, r"\beval\(|new Function|innerHTML|document\.write")

    def test_all_of_it_is_small(self):
        compressed = sum(len(zlib.compress(text.encode(), 6)) for text in [*self.pages.values(), *self.parts().values()])
        self.assertLess(compressed, 150_000)

    def test_a_part_is_asked_for_again_only_when_it_has_changed(self):
        first = self.get("/page/main.js")
        self.assertEqual(first.getheader("Cache-Control"), "no-cache")
        again = self.server.request("GET", "/page/main.js", headers={"If-None-Match": first.getheader("ETag")})
        self.assertEqual((again.status, again.data), (304, b""))

    def test_nothing_at_an_address_is_a_page_for_browsers(self):
        for path in ("/nothing", "/page/none.js", "/v1/systems/none", "/errors/none"):
            with self.subTest(path):
                page = self.get(path)
                self.assertEqual(page.status, 404)
                self.assertRegex(page.getheader("Content-Type"), "^text/html")
                self.assertIn("default-src 'none'", page.getheader("Content-Security-Policy"))
                self.assertRegex(page.data.decode(), "<main>")
                problem = self.server.request("GET", path)
                self.assertEqual(problem.getheader("Content-Type"), "application/problem+json")
        self.assertNotIn("<script>", self.get("/%3Cscript%3E").data.decode())

    def test_the_browser_is_told_to_load_nothing_else(self):
        for page, text in self.pages.items():
            policy = self.get(page).getheader("Content-Security-Policy")
            self.assertIn("default-src 'none'", policy)
            self.assertNotIn("unsafe", policy)
            self.assertEqual(Links(text).handlers, [])
            self.assertNotRegex(text, r"<script(?![^>]*src=)|<style")


if __name__ == "__main__":
    unittest.main()

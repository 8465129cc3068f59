"""The pages for browsers: their links lead somewhere here, nothing comes from elsewhere, and their program works."""

import html.parser
import json
import pathlib
import re
import subprocess
import unittest

from running_qdot import RunningQdot

HERE = pathlib.Path(__file__).parent
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
                with self.subTest(page=page, target=target):
                    self.assertRegex(target, "^/(?!/)")
                    self.assertEqual(self.get(target).status, 200)

    def test_nothing_comes_from_elsewhere(self):
        parts = [*self.pages.values(), self.get("/docs/docs.js").data.decode(), self.get("/docs/style.css").data.decode()]
        for text in parts:
            self.assertNotRegex(text, r"https?:|@import|\burl\(|\bimport\b")

    def test_the_browser_is_told_to_load_nothing_else(self):
        for page, text in self.pages.items():
            policy = self.get(page).getheader("Content-Security-Policy")
            self.assertIn("default-src 'none'", policy)
            self.assertNotIn("unsafe", policy)
            self.assertEqual(Links(text).handlers, [])
            self.assertNotRegex(text, r"<script(?![^>]*src=)|<style")

    def test_every_form_of_the_docs_gets_its_answer_and_so_does_its_line_for_the_shell(self):
        command = ["node", HERE / "docs_page.mjs", f"http://127.0.0.1:{self.server.port}"]
        run = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)
        self.assertEqual(run.returncode, 0, run.stderr)
        head, *forms = map(json.loads, run.stdout.splitlines())
        self.assertIn("Version", head["about"])
        operations = re.findall('"operationId":', self.get("/openapi.json").data.decode())
        self.assertEqual(len(forms), len(operations))
        for form in forms:
            with self.subTest(form["operation"]):
                self.assertRegex(form["status"], "^200 ")
                shell = subprocess.run(["sh", "-c", form["shell"] + " --silent --fail --noproxy '*' --output /dev/null"],
                                       timeout=60, check=False)
                self.assertEqual(shell.returncode, 0, form["shell"])


if __name__ == "__main__":
    unittest.main()

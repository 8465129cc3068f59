"""TypeScript clients generated from /openapi.json, and programs that ask them questions.json.

Each question becomes a line of TypeScript with its request and the way to the value written out, so that the compiler
holds both against the generated types.
"""

import json
import pathlib

from node import MODULES, node

QUESTIONS = json.loads(pathlib.Path(__file__).with_name("questions.json").read_text())
OPTIONS = {"strict": True, "target": "ES2022", "module": "NodeNext", "moduleResolution": "NodeNext", "outDir": "out",
           "skipLibCheck": True, "types": []}
# Node asks for the ends of file names, which this generator leaves out by itself.
HEY_API = {"input": "openapi.json", "output": {"path": "sdk", "importFileExtension": ".js"},
           "plugins": ["@hey-api/client-fetch", "@hey-api/typescript", "@hey-api/sdk"]}
START = "declare const process: { argv: string[] };\nconst address = process.argv[2]!;\nconst answers: unknown[] = [];\n"


def way_to(pointer):
    """"/modes/0/omega" as ".modes[0]!.omega"; what may be missing on the way is passed over."""
    parts = pointer.strip("/").split("/")
    return "".join(f"?.[{part}]" if part.isdigit() else f"?.{part}" for part in parts)


def program_of_openapi_fetch(_):
    lines = ['import createClient from "openapi-fetch";', 'import type { paths } from "./schema.js";', START,
             "const client = createClient<paths>({ baseUrl: address });"]
    for question in QUESTIONS:
        call = f'await client.POST("/v1/{question["ask"]}", {{ body: {json.dumps(question["request"])} }})'
        lines.append(value_of(call, question))
    return "\n".join([*lines, "console.log(JSON.stringify(answers));\n"])


def program_of_hey_api(operations):
    names = sorted({operations[question["ask"]] for question in QUESTIONS})
    lines = [f'import {{ {", ".join(names)} }} from "./sdk/sdk.gen.js";', 'import { client } from "./sdk/client.gen.js";',
             START, "client.setConfig({ baseUrl: address });"]
    for question in QUESTIONS:
        call = f'await {operations[question["ask"]]}({{ body: {json.dumps(question["request"])} }})'
        lines.append(value_of(call, question))
    return "\n".join([*lines, "console.log(JSON.stringify(answers));\n"])


def value_of(call, question):
    if "refused" in question:
        return f'answers.push(({call}).error{way_to(question["refused"])});'
    # Where an answer has one of several forms, its members tell which.
    first = question["at"].split("/")[1]
    return f'{{ const it = ({call}).data; answers.push(it && "{first}" in it ? it{way_to(question["at"])} : undefined); }}'


GENERATORS = {
    "openapi-typescript": (["openapi-typescript/bin/cli.js", "openapi.json", "-o", "schema.d.ts"], program_of_openapi_fetch),
    "hey-api": (["@hey-api/openapi-ts/bin/run.js"], program_of_hey_api),
}


def answers_of(generator, document, address, directory):
    """What the generated client answers to the questions: generated, compiled strictly and run in `directory`."""
    directory = pathlib.Path(directory)
    (directory / "node_modules").symlink_to(MODULES)
    (directory / "openapi.json").write_text(json.dumps(document))
    (directory / "package.json").write_text('{"type": "module"}')
    (directory / "openapi-ts.config.mjs").write_text(f"export default {json.dumps(HEY_API)};")
    command, program = GENERATORS[generator]
    succeed(node(command[0], *command[1:], directory=directory))
    operations = {path.removeprefix("/v1/"): methods["post"]["operationId"]
                  for path, methods in document["paths"].items() if "post" in methods and "." not in path}
    (directory / "main.ts").write_text(program(operations))
    (directory / "tsconfig.json").write_text(json.dumps({"compilerOptions": {**OPTIONS, "lib": ["ES2022", "DOM", "DOM.Iterable"]},
                                                         "files": ["main.ts"]}))
    succeed(node("typescript/bin/tsc", "-p", "tsconfig.json", directory=directory))
    return json.loads(succeed(node(directory / "out" / "main.js", address, directory=directory)).stdout)


def succeed(run):
    if run.returncode != 0:
        raise AssertionError((run.stdout + run.stderr)[-4000:])
    return run

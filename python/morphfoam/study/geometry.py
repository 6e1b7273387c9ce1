# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Responses that need no flow, such as a volume, at any point: by one command in
a copy of the baseline. What was found is kept in a file, so that a descent that
is started again finds the same at once."""

import json
import shutil

from morphfoam.optimisation.sqp import Failure

from . import case_folder, failures, outcomes, process, responses, worker


class Geometry:
    """values(parameters) of the responses in names: those with a gradient,
    and expressions of these."""

    def __init__(self, study, folder):
        self.study, self.command = study, study.descend.geometry
        self.case, self.file = folder / "geometry", folder / "geometry.jsonl"
        self.names = exact_names(study) if self.command else []
        self.baseline = outcomes.baseline_values(study)
        self.found = {}
        if self.names:
            self._open()

    def _open(self):
        """Take what is in the file, if it was found in the same way; a line
        that is not whole was being written when the descent was killed."""
        made = outcomes.read(self.study, outcomes.BASELINE)
        texts = outcomes.response_texts(self.study)
        recipe = {
            "command": self.command,
            "responses": {name: texts[name] for name in self.names},
            "derived": {d.name: d.expression.text for d in self.study.derived},
            "parameters": self.study.names,
            "baseline": made.finished if made else "",
        }
        lines = []
        if self.file.exists():
            for line in self.file.read_text().splitlines():
                try:
                    lines.append(json.loads(line))
                except ValueError:
                    break
        if lines and lines[0] == json.loads(json.dumps(recipe)):
            self.found = {tuple(p): content for p, content in lines[1:]}
        else:
            lines = [recipe]
            shutil.rmtree(self.case, ignore_errors=True)
        self.file.parent.mkdir(parents=True, exist_ok=True)
        self.file.write_text("".join(json.dumps(x) + "\n" for x in lines))
        shutil.rmtree(self.case, ignore_errors=True)

    def values(self, parameters):
        """Responses and tables of derivatives, or a Failure."""
        key = tuple(parameters[name] for name in self.study.names)
        if key not in self.found:
            self.found[key] = self._ask(parameters)
            with self.file.open("a") as file:
                file.write(json.dumps([key, self.found[key]]) + "\n")
        content = self.found[key]
        if "reason" in content:
            return Failure(content["reason"], content["attainable"])
        return content["responses"], content["gradients"]

    def _ask(self, parameters):
        if not self.case.exists():
            worker.copy_baseline(self.study, self.case)
        shutil.rmtree(self.case / "postProcessing", ignore_errors=True)
        case_folder.write_parameters(self.study, self.case, parameters)
        log = self.case / "log.geometry"
        environment = worker.environment(self.study, self.case)
        status = process.run(self.command, self.case, log, None, environment)[
            0
        ]
        if status:
            return {
                "reason": f"geometry: {failures.why(log, status)}",
                "attainable": failures.attainable(self.case, [log]),
            }
        reader = responses.Reader(
            self.study, self.case, parameters, environment, self.baseline
        )
        try:
            return {
                "responses": reader.responses(self.names),
                "gradients": reader.gradients(self.names),
            }
        except responses.ResponseError as error:
            return {"reason": f"geometry: {error}", "attainable": None}


def exact_names(study):
    """The responses whose gradients follow from tables."""
    known = set(study.baseline_values)
    names = []
    for name, response in study.responses.items():
        if response.gradient or (
            response.expression
            and response.expression.names <= known
            and response.expression.names & set(names)
        ):
            names.append(name)
            known.add(name)
    return names

# SPDX-License-Identifier: LGPL-2.1-or-later
"""How a run stands, in a word, a sentence, and what to try if it did not go well."""
import re
from dataclasses import dataclass, field

BRIEF = 300  # characters
TRY = re.compile(r"(?:(?<=[.:;)] )|(?<=\n)|^)Try:? +(.+?)(?=\.\s|\.?$)", re.S)
KEPT = re.compile(r"(The state before it .*)", re.S)

GROWING = [
    "shorter steps: --set \"Time/Step=...\", or a Time / Tolerance that chooses them",
    "Scheme = simultaneous, if bodies and fluid are solved in turns (time_splitting): light bodies in heavy fluids need it",
    "Time / Energy monitor = redo, which makes steps anew that create energy",
    "an integrator that damps what steps do not resolve, such as trapezoid_bdf2",
]
UNDECIDED = ["Time / Energy monitor = warn keeps the account of what is put in, with which it can be told"]
VIOLATED = ["shorter steps and finer cells; a conserved quantity that drifts comes from the resolution"]


@dataclass
class Verdict:
    """`kind` names the colour: good, bad, warning, or neutral for a run that has not ended."""
    kind: str
    word: str
    sentence: str
    failure: str = ""
    advice: list = field(default_factory=list)

    def brief(self):
        """The first sentences of the failure, so that what to try is on the first screen, too."""
        ends = [end.end() for end in re.finditer(r"\.(?= |$)", self.failure) if end.end() <= BRIEF]
        return self.failure[:max(ends)] if ends else self.failure

    def rest(self):
        return self.failure[len(self.brief()):].strip()


def advice_of(failure):
    """What the message of a failure says to try."""
    return [" ".join(each.split()) for each in TRY.findall(KEPT.sub("", failure).strip())]


def without_advice(failure):
    return " ".join(TRY.sub("", KEPT.sub("", failure).strip()).split()).rstrip(" .;:").replace(". .", ".") + "."


def of_failure(certificate, failure):
    advice = advice_of(failure)
    if "growing since" in certificate.get("text", ""):
        advice += GROWING
    elif not advice:
        advice = [GROWING[0], "finer cells where bodies are bent most"]
    at = re.match(r"failed (at t = \S+ s)", certificate.get("text", ""))
    grew = re.search(r"; (growing since .*)", certificate.get("text", ""))
    sentence = f"{at[1] if at else ''}{', after something was ' + grew[1] if grew else ''}".strip(", ")
    return Verdict("bad", "failed", sentence, without_advice(failure), advice)


def kept(certificate):
    """Of the laws that the certificate has looked at, besides that of the energy."""
    laws = [each.get("law", "") for each in certificate.get("margins", [])]
    what = [word for word in ("volume", "momentum") if any(law.startswith(word) for law in laws)]
    return f" {' and '.join(what).capitalize()} {'are' if len(what) > 1 else 'is'} conserved." if what else ""


def negative_margins(certificate):
    return [each.get("law", "") for each in certificate.get("margins", []) if not (each.get("margin") or 0) >= 0]


def of_certificate(certificate, prefix):
    word, text = certificate.get("verdict", ""), certificate.get("text", "")
    violated = negative_margins(certificate)
    if word == "growing":
        return Verdict("bad", prefix + word, text, advice=GROWING)
    if word == "undecided":
        return Verdict("warning", prefix + word, text, advice=UNDECIDED)
    if violated:
        return Verdict("warning", prefix + (word or "stable"), text, advice=VIOLATED)
    if text == "stable":
        text = "No energy appeared from nowhere." + kept(certificate) + " This does not say how accurate the run is."
    return Verdict("good" if not prefix else "neutral", prefix + word, text)


def reached(results):
    table = results.statistics
    return f"step {table.column('Step')[-1]:.0f}, t = {table.column('Time')[-1]:.6g} s" if len(table) else "no step"


def of_any(results):
    """The verdict of a run whose files may be anything."""
    return results.attempt("summary.json", of, Verdict("neutral", "no verdict", "The certificate cannot be read."))


def of(results):
    """The verdict of a run: by its certificate, its failure, and whether it is still going on."""
    certificate, failure = results.summary.get("certificate", {}), results.summary.get("failure", "")
    if results.is_running():
        running = Verdict("neutral", "running", f"has reached {reached(results)}")
        return of_certificate(certificate, "running, so far ") if certificate else running
    if certificate.get("verdict") == "failed":
        return of_failure(certificate, failure)
    if failure:
        stopped = of_certificate(certificate, "stopped, ")
        stopped.failure = without_advice(failure)
        return stopped
    if not results.summary.get("ended", results.has_ended):
        return Verdict("warning", "not ended", f"The run was killed, or its end was not written. It has reached {reached(results)}.",
                       advice=["resume it from its last checkpoint, see below"] if results.has("checkpoint") else [])
    if not certificate:
        return Verdict("neutral", "no verdict", f"The run has left no certificate; it has reached {reached(results)}.")
    return of_certificate(certificate, "")

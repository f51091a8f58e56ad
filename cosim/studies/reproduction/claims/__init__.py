"""What judges the claims C1 to C18 of the source study: the functions that `claims.toml` names."""

from pkgutil import resolve_name

from ..claim import CLAIM_IDS, WRITTEN, Judge

JUDGES: dict[str, Judge] = {
    claim: resolve_name(f"{__name__}.{WRITTEN[claim]['judge']}") for claim in CLAIM_IDS
}

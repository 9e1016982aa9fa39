"""Uploading, by the hub's own library."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from stampede.faults import fault


def ready(repository: str) -> Any:
    """The library, signed in. Raises Error or ImportError before any work is done for nothing."""
    try:
        import huggingface_hub
    except ImportError as error:
        raise ImportError('huggingface_hub is missing\n    pip install "stampede-sim[publish]"') from error
    if not huggingface_hub.get_token():
        raise fault(
            repository, "nobody is signed in to the hub", "hf auth login, or set HF_TOKEN; --dry-run needs none"
        )
    return huggingface_hub


def upload(library: Any, folder: Path, repository: str) -> None:
    """Files that are there under other names stay there. Raises Error with what the hub says."""
    hub = library.HfApi()
    try:
        hub.create_repo(repository, repo_type="dataset", exist_ok=True)
        hub.upload_folder(
            repo_id=repository, repo_type="dataset", folder_path=str(folder), commit_message="Made by stampede.publish"
        )
    except Exception as error:  # of the library, and of those that it stands on
        words = " ".join(str(error).split())[:300]
        cure = f"the folder is whole: hf upload {repository} {folder} --repo-type dataset"
        raise fault(repository, f"it was not uploaded ({type(error).__name__}: {words})", cure) from error

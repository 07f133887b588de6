from .file_check import check_file, describe_check

__all__ = ["check_file", "describe_check"]

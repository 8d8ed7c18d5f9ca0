"""Exact solutions"""
